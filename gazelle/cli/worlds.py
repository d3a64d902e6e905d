"""List the worlds that come with Gazelle, and their files."""

from __future__ import annotations

import argparse
import sys

from gazelle.cli import showing


def configure(parser: argparse.ArgumentParser) -> None:
    """There are no arguments."""
    del parser


def run(args: argparse.Namespace) -> int:
    """Do it; returns the exit code."""
    del args
    from gazelle import assets

    rows = [(name, str(path)) for name, path in assets.worlds().items()]
    sys.stdout.write(showing.table([("WORLD", "FILE"), *rows]))
    return 0
