"""The nodes ``gzserver`` and ``gazebo`` of the package ``gazebo_ros``."""

from __future__ import annotations

import argparse
import os
import threading
import warnings
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from gazelle import assets
from gazelle.bridges.serving import RosServer, refuse_twin
from gazelle.errors import ResolveError, SimulationWarning
from gazelle.formats.near_names import closest_below, describe_folder
from gazelle.simulation import Simulation
from gazelle_ros import names
from gazelle_ros.base.bundled_packages import published, published_hint
from gazelle_ros.base.interrupts import stopping
from gazelle_ros.builtin.arguments import parse_arguments

# Options that change nothing here, with a value and without.
_PASSED_OVER = ("-g", "--gui-plugin", "-o", "--profile")
_IGNORED = ("--verbose", "--lockstep", "--minimal_comms", "-q", "--quiet", "--pose")
# Options without an implementation here: each gives one warning.
_NO_RECORDING = "the simulator writes no log: 'gazelle bag record -a' records topics"
_NOT_HERE = {
    **dict.fromkeys(("-r", "--record", "--record_resources"), _NO_RECORDING),
    **dict.fromkeys(("--record_path", "--record_encoding"), _NO_RECORDING),
    **dict.fromkeys(("--record_period", "--record_filter"), _NO_RECORDING),
    **dict.fromkeys(("-p", "--play"), "logs of Gazebo are not played"),
    "--initial_sim_time": "time begins at zero",
}
_WITHOUT_VALUE = ("-r", "--record", "--record_resources")
_ENGINES = ("ode", "mujoco")  # worlds for ODE are what MuJoCo is made to resemble


def main(arguments: Sequence[str]) -> int:
    """Run a world on the graph until shutdown; returns the exit code."""
    found = parse_arguments(arguments, "gazebo")
    options = parse_options(found.plain)
    place = names.as_namespace(found.options["namespace"])
    refuse_twin(names.join(place, found.options["name"]), found.options.get("master_uri"))
    # The node comes first: what the world warns of while it is read goes to /rosout, too.
    with found.start() as node, _simulation(options, place) as sim:
        for plugin in options.plugins:
            sim.load_plugin(plugin)
        if options.paused:
            sim.pause()
        server = RosServer(
            sim,
            node,
            None,
            world=0,
            monotonic_clock=bool(node.get_param("~monotonic_clock", False)),
        )
        with server, stopping() as stop:
            _run(server, stop, options.iterations * sim.physics.time_step or None)
    return 0


def _simulation(options: argparse.Namespace, namespace: str) -> Simulation:
    """Return the world that runs; warn of options without effect."""
    for notice in dict.fromkeys(options.notices):
        warnings.warn(notice, SimulationWarning, stacklevel=2)
    return Simulation(find_world(options.world), seed=options.seed, namespace=namespace.rstrip("/"))


def _run(server: RosServer, stop: threading.Event, seconds: float | None) -> None:
    """Run until a signal, which a thread hands on."""

    def wait() -> None:
        stop.wait()
        server.stop()

    waiter = threading.Thread(target=wait, name="gzserver-end", daemon=True)
    waiter.start()
    try:
        server.run(seconds)
    finally:
        stop.set()
        waiter.join()


def parse_options(arguments: Sequence[str]) -> argparse.Namespace:
    """Parse the command line of ``gzserver``: ``world`` is its file as Gazebo's users name it."""
    parser = argparse.ArgumentParser("gzserver", allow_abbrev=False)
    parser.add_argument("world", nargs="?", default="worlds/empty.world")
    parser.add_argument("-u", "--pause", dest="paused", action="store_true")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--iters", dest="iterations", type=int, default=0)
    parser.add_argument("-s", "--server-plugin", dest="plugins", action="append", default=[])
    for flag in _IGNORED:
        parser.add_argument(flag, action="store_true", dest="ignored")
    for flag in _PASSED_OVER:
        parser.add_argument(flag, action="append", dest="passed_over")
    parser.add_argument("-e", "--physics", default="ode")
    for flag, notice in _NOT_HERE.items():
        to = partial(parser.add_argument, flag, dest="notices", default=[])
        if flag in _WITHOUT_VALUE:
            to(action="append_const", const=notice)
        else:
            to(action="append", type=_noticed(notice))
    options = parser.parse_args(list(arguments))
    if options.physics not in _ENGINES:
        options.notices.append(f"there is no physics '{options.physics}': MuJoCo computes it")
    return options


def _noticed(notice: str) -> Callable[[str], str]:
    """Return an argument type that accepts any value and returns the notice."""
    return lambda _value: notice


def find_world(name: str) -> str:
    """Return a world's file as Gazebo looks for it, or the name itself for what ``load`` finds.

    Raises:
        ResolveError: A path that is nowhere.
    """
    folders = [Path(), *_resource_path(), assets.root()]
    for folder in folders:
        file = published(folder / name)
        if file.is_file():
            return str(file)
    if "/" in name and "://" not in name:
        hint = published_hint(name) or _hint_of(name, folders)
        raise ResolveError("there is no such world", file=name, hint=hint)
    return name


def _hint_of(name: str, folders: Sequence[Path]) -> str:
    """Return a hint for the path of a world that is nowhere."""
    if Path(name).is_absolute():
        return describe_folder(Path(name))
    close = next(filter(None, (closest_below(folder, name) for folder in folders)), None)
    return close or f"looked in {', '.join(str(folder) for folder in folders)}"


def _resource_path() -> list[Path]:
    text = os.environ.get("GAZEBO_RESOURCE_PATH", "")
    return [Path(part) for part in text.split(os.pathsep) if part]
