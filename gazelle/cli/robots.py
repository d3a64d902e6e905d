"""List the bundled robots.

gazelle robots
gazelle robots --long
"""  # this is the text of --help

from __future__ import annotations

import argparse

from gazelle.cli.bundled import configure, show

__all__ = ["configure", "run"]


def run(args: argparse.Namespace) -> int:
    """Print the list; return the exit code."""
    from gazelle import assets

    show("ROBOT", assets.robots(), long=args.long)
    return 0
