"""rosmaster's interface: a master in this process."""

import sys

from gazelle_ros.compat import commands
from gazelle_ros.compat.rosmaster import master, master_api
from gazelle_ros.compat.rosmaster.master import DEFAULT_MASTER_PORT, Master

__all__ = ["DEFAULT_MASTER_PORT", "Master", "master", "master_api", "rosmaster_main"]


def rosmaster_main() -> None:
    """Run ``rosmaster`` with this process's command line.

    Raises:
        SystemExit: It failed.
    """
    commands.run("master", [word for word in sys.argv if word != "--core"])
