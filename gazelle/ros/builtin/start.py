"""``python -m gazelle.ros.builtin.start PACKAGE TYPE ...``: run a built-in node."""

from __future__ import annotations

import sys

from gazelle.errors import Error
from gazelle.ros.builtin.registry import main_of


def main(arguments: list[str]) -> int:
    """Run the node that the first two arguments name; returns the exit code."""
    package, kind, *rest = arguments
    try:
        return main_of(package, kind)(rest)
    except Error as error:
        sys.stderr.write(f"[{package}/{kind}] {error}\n")
        return 1
    except KeyboardInterrupt:
        return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
