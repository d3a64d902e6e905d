"""The program ``gazelle-ros``, also ``python -m gazelle_ros``: few imports until Ctrl-C is handled."""

import sys

from gazelle_ros.base.early_signals import ending_quietly


def main() -> int:
    """Import and run the command line; returns the exit code."""
    try:
        with ending_quietly():
            from gazelle_ros.cli.main import main as run
        return run()
    except KeyboardInterrupt:  # before or after the command
        return 130


if __name__ == "__main__":
    sys.exit(main())
