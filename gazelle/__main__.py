"""The program ``gazelle``, also ``python -m gazelle``: few imports until Ctrl-C is handled."""

import sys

from gazelle_ros.base.early_signals import run_program


def main() -> int:
    """Import and run the command line; returns the exit code."""
    return run_program("gazelle.cli.main")


if __name__ == "__main__":
    sys.exit(main())
