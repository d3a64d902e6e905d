"""The node ``stageros`` of the package ``stage_ros``."""

from __future__ import annotations

import argparse
import threading
from collections.abc import Sequence

from gazelle.simulation import Simulation
from gazelle.stage import stage_of
from gazelle.stage.bridge.interface import StageInterface
from gazelle_ros.base.interrupts import stopping
from gazelle_ros.builtin.arguments import parse_arguments


def main(arguments: Sequence[str]) -> int:
    """Run a Stage world on the graph until shutdown; returns the exit code.

    The pace is what the file's ``speedup`` says, with a window or without.
    """
    found = parse_arguments(arguments, "stageros")
    options = parse_options(found.plain)
    # The node comes first: what the world warns of while it is read goes to /rosout, too.
    with found.start() as node, Simulation(options.world, "planar") as sim:
        speedup = stage_of(sim).description.speedup
        interface = StageInterface(
            sim, node, rate=speedup if speedup > 0.0 else None, model_names=options.model_names
        )
        with interface, stopping() as stop:
            _run(interface, stop)
    return 0


def _run(interface: StageInterface, stop: threading.Event) -> None:
    """Run until a signal, which a thread hands on."""

    def wait() -> None:
        stop.wait()
        interface.stop()

    waiter = threading.Thread(target=wait, name="stageros-end", daemon=True)
    waiter.start()
    try:
        interface.run()
    finally:
        stop.set()
        waiter.join()


def parse_options(arguments: Sequence[str]) -> argparse.Namespace:
    """Parse the command line of ``stageros``: ``world`` is its file."""
    parser = argparse.ArgumentParser("stageros", allow_abbrev=False)
    parser.add_argument("-g", action="store_true", help="no window; there is none anyway")
    parser.add_argument("-u", dest="model_names", action="store_true", help="names of models")
    parser.add_argument("world", help="the world file")
    return parser.parse_args(list(arguments))
