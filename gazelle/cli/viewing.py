"""The flag ``--view``: a page in a browser that shows what runs."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from gazelle.closing import Closeable

if TYPE_CHECKING:
    from gazelle.simulation import Simulation
    from gazelle.training import Progress


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


@contextmanager
def viewing(sim: Simulation, args: argparse.Namespace) -> Iterator[str]:
    """Serve the page while the simulation runs, if it is wanted.

    Yields:
        A line with its address, "" without a page. Print it last, where it is found again.

    Raises:
        MissingExtraError: What serves the page is not installed.
        Error: The port is taken.
    """
    if args.view is None:
        yield ""
        return
    from gazelle.viewer.live import LiveView

    with LiveView(sim, port=args.view) as view:
        yield f"view {view.url}\n"


def watched(progress: Progress, args: argparse.Namespace) -> Progress:
    """The display of a training, with a page that shows some of the copies if it is wanted.

    Raises:
        MissingExtraError: What serves the page is not installed.
    """
    if args.view is None:
        return progress
    from gazelle.training.progress import Watched
    from gazelle.viewer.page.server import required_viser

    required_viser()

    def watch(env: object) -> Closeable:
        from gazelle.viewer.live import LiveView

        simulation = _simulation_of(env)
        if simulation is None:
            progress.say("there is nothing to view: the task has no simulation")
            return _Nothing()
        view = LiveView(simulation, port=args.view, only_looking=True)
        progress.say(f"view {view.url}")
        return view

    return Watched(progress, watch)


class _Nothing(Closeable):
    """No page."""

    def close(self) -> None:
        """There is nothing to close."""


def _simulation_of(env: object) -> Simulation | None:
    """What runs in a vector environment: its own, its task's, or its first copy's."""
    from gazelle.simulation import Simulation

    bare = getattr(env, "unwrapped", env)
    first = next(iter(getattr(bare, "envs", ())), None)
    inner = getattr(first, "unwrapped", None)
    for owner in (bare, getattr(bare, "task", None), inner, getattr(inner, "task", None)):
        found = getattr(owner, "simulation", None)
        if isinstance(found, Simulation):
            return found
    return None
