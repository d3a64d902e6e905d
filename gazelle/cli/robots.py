"""List the robots that come with Gazelle, and their files."""

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

    rows = [(name, str(path)) for name, path in assets.robots().items()]
    sys.stdout.write(showing.table([("ROBOT", "FILE"), *rows]))
    return 0
