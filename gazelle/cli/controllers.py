"""List the supported types of ros_control controllers."""

from __future__ import annotations

import argparse
import sys

from gazelle.cli import showing


def configure(parser: argparse.ArgumentParser) -> None:
    """Add no arguments."""
    del parser


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    del args
    from gazelle.control import types

    rows = [("TYPE", "WHAT IT DOES"), *((name, _purpose(name)) for name in types())]
    sys.stdout.write(showing.table(rows))
    return 0


def _purpose(name: str) -> str:
    """Return the purpose of a type, or the reason why it cannot be loaded."""
    from gazelle.control import registry

    try:
        return registry.purpose(name).replace("`", "")
    except Exception as error:  # noqa: BLE001  anything may go wrong in an import
        return f"cannot be had: {error}"
