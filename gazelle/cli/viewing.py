"""The flag ``--view``: a page in a browser that shows what runs."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from gazelle_ros.base.argument_types import port_number

if TYPE_CHECKING:
    from gazelle.simulation import Simulation
    from gazelle.training import Progress


LIVE = "serve a web page on this machine with a live, interactive 3D view; print its address"
COPIES = "serve a web page on this machine with some environments and the learning curve; print its address"


def add_view(parser: argparse.ArgumentParser, purpose: str = LIVE) -> None:
    """Declare the flag, with its purpose as help."""
    parser.add_argument(
        "--view",
        metavar="PORT",
        type=port_number,
        nargs="?",
        const=0,
        help=purpose,
    )


@contextmanager
def viewing(sim: Simulation, args: argparse.Namespace) -> Iterator[str]:
    """Serve the page while the simulation runs, on request.

    Yields:
        A line with its address, "" without a page. Print it last, where it is found again.

    Raises:
        MissingExtraError: The package that serves the page is not installed.
        Error: The port is taken.
    """
    if args.view is None:
        yield ""
        return
    from gazelle.viewer.live import LiveView

    with LiveView(sim, port=args.view) as view:
        yield f"view {view.url}\n"


def watched(progress: Progress, args: argparse.Namespace) -> Progress:
    """Return the display of a training, with a page that shows some of the copies on request.

    Raises:
        MissingExtraError: The package that serves the page is not installed.
    """
    if args.view is None:
        return progress
    from gazelle.training.progress import CopiesView, Watched
    from gazelle.viewer.page.server import required_viser

    required_viser()

    def watch(env: object) -> CopiesView:
        from gazelle.viewer.training_page import TrainingPage

        owner = simulated(env)
        if owner is None:
            progress.say("there is nothing to view: the task has no simulation")
            return _Nothing()
        page = TrainingPage(
            owner.simulation, lambda: getattr(owner, "goal_places", None), args.view
        )
        progress.say(f"view {page.url}")
        return page

    return Watched(progress, watch)


class _Nothing:
    """No page."""

    def note(self, done: int, total: int, summary: dict[str, float]) -> None:
        """Do nothing: there is nothing to show it on."""

    def close(self) -> None:
        """Do nothing: there is nothing to close."""


def simulated(env: object) -> Any:
    """Return what owns the simulation of a vector environment, or of its first copy; or None."""
    bare = getattr(env, "unwrapped", env)
    first = next(iter(getattr(bare, "envs", ())), None)
    for found in (bare, getattr(first, "unwrapped", None)):
        owner = found
        while owner is not None:
            if getattr(owner, "simulation", None) is not None:
                return owner
            owner = getattr(owner, "task", None)
    return None
