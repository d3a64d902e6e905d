"""List the plugins that files can name, and what they do."""

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
    from gazelle.description import Plugin
    from gazelle.simulation import registry

    rows = [("PLUGIN", "WHAT IT DOES")]
    for name in registry.names():
        found = registry.find(Plugin(name=name, filename=name))
        purpose = (found.__doc__ or "").strip().partition("\n")[0] if found else ""
        rows.append((name, purpose))
    sys.stdout.write(showing.table(rows))
    return 0
