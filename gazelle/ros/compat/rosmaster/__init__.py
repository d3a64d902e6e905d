"""rosmaster's interface: a master in this process."""

from gazelle.ros.compat.rosmaster import master, master_api
from gazelle.ros.compat.rosmaster.master import DEFAULT_MASTER_PORT, Master

__all__ = ["DEFAULT_MASTER_PORT", "Master", "master", "master_api", "rosmaster_main"]


def rosmaster_main() -> None:
    """Run the command ``rosmaster`` with this process's arguments, and end it."""
    import sys

    from gazelle.ros.builtin.commands import run_command

    arguments = [each for each in sys.argv[1:] if each != "--core"]
    sys.exit(run_command("master", arguments))
