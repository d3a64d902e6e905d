"""List the bundled worlds.

gazelle worlds
gazelle worlds --long
"""  # this is the text of --help

from __future__ import annotations

import argparse

from gazelle.cli.bundled import configure, show

__all__ = ["configure", "run"]


def run(args: argparse.Namespace) -> int:
    """Print the list; return the exit code."""
    from gazelle import assets

    show("WORLD", assets.worlds(), long=args.long)
    return 0
