"""The flag ``--view``: a page in a browser that shows what runs."""

from __future__ import annotations

import argparse
import sys
from contextlib import AbstractContextManager, nullcontext
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gazelle.simulation import Simulation


def add_view(parser: argparse.ArgumentParser) -> None:
    """Declare the flag."""
    parser.add_argument(
        "--view",
        metavar="PORT",
        type=int,
        nargs="?",
        const=0,
        help="a page in a browser on this machine that shows it live and lets you take part; its address is printed",
    )


def viewing(sim: Simulation, args: argparse.Namespace) -> AbstractContextManager[object]:
    """The page while the simulation runs, if it is wanted.

    Raises:
        MissingExtraError: What serves the page is not installed.
        Error: The port is taken.
    """
    if args.view is None:
        return nullcontext()
    from gazelle.viewer.live import LiveView

    view = LiveView(sim, port=args.view)
    sys.stdout.write(f"view {view.url}\n")
    sys.stdout.flush()
    return view
