"""List of bundled files for ``gazelle robots`` and ``gazelle worlds``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping
from pathlib import Path

from gazelle.cli import showing


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of both commands."""
    parser.add_argument("--long", action="store_true", help="show paths instead of descriptions")


def show(kind: str, files: Mapping[str, Path], *, long: bool) -> None:
    """Print the name of each file with its description, or with its path.

    Args:
        kind: Title of the column of names.
        files: Files by name.
        long: Print paths.
    """
    from gazelle.assets.descriptions import description

    rows = [(name, str(path) if long else description(path)) for name, path in files.items()]
    sys.stdout.write(showing.table([(kind, "FILE" if long else "DESCRIPTION"), *rows]))
