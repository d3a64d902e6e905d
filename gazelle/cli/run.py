"""Simulate a world or robot file, without a window.

The file is an SDF or .world, a URDF or xacro, a Stage .world, a map_server map,
a model's folder, or a bundled name (see 'gazelle worlds').

  gazelle run turtlebot3_stage_1 --for 60 --rate max
  gazelle run my_robot.urdf.xacro
  gazelle run turtlebot3_world --ros --spawn turtlebot3_burger
  gazelle run turtlebot3_world --ros --spawn turtlebot3_burger@-2,-0.5
  gazelle run fleet --view
  gazelle run pick_and_place --spawn fetch --ros --moveit
  gazelle run map.yaml --engine planar --spawn turtlebot3_burger --ros

A robot or model file is loaded into a world with ground and sun.
With --ros the simulation is a ROS 1 node with the topics and services of
gazebo_ros, such as /clock and /gazebo/spawn_urdf_model. It starts a master if
none answers at ROS_MASTER_URI.
"""  # this is the text of --help

from __future__ import annotations

import argparse
import math
import sys
import time
from typing import TYPE_CHECKING

from gazelle.cli.description_publisher import publishing_descriptions
from gazelle.cli.grounding import add_ground
from gazelle.cli.moveit_option import add_moveit, running_moveit, start_requested_controllers
from gazelle.cli.progress_line import announced
from gazelle.cli.rosbridge_option import add_rosbridge, running_rosbridge
from gazelle.cli.spawning import parse_spawn, spawn
from gazelle.cli.viewing import add_view, viewing
from gazelle.errors import SimulationError
from gazelle_ros.base.argument_types import positive_float
from gazelle_ros.base.output import say

if TYPE_CHECKING:
    from gazelle.bridges import RosServer
    from gazelle.description import World
    from gazelle.simulation import Simulation
    from gazelle.stage import StageWorld
    from gazelle.stage.bridge import StageServer

_STATUS_EVERY = 0.5
_SLICE = 0.05
_MANY = 20  # models beyond which their names are not listed, and that are not driven by hand


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "file", metavar="FILE", help="file to simulate, or the name of a bundled world"
    )
    parser.add_argument(
        "--engine",
        metavar="NAME",
        help="physics engine: mujoco or planar (default mujoco; planar for Stage files)",
    )
    parser.add_argument(
        "--for",
        dest="seconds",
        metavar="SECONDS",
        type=positive_float,
        help="simulated time to run (default: until Ctrl-C)",
    )
    parser.add_argument(
        "--rate",
        metavar="X",
        type=_rate,
        help="real-time factor, or max (default 1.0; for Stage files their speedup)",
    )
    parser.add_argument("--paused", action="store_true", help="start paused")
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="random seed (default 0)")
    parser.add_argument(
        "--wander",
        action="store_true",
        help="run Stage's wander controller on the robots of a Stage file",
    )
    add_ground(parser)
    add_view(parser)
    parser.add_argument("--ros", action="store_true", help="connect to a ROS 1 graph")
    add_moveit(parser)
    add_rosbridge(parser)
    parser.add_argument(
        "--spawn",
        metavar="ROBOT[@X,Y[,YAW]]",
        type=parse_spawn,
        action="append",
        default=[],
        help="also spawn a robot: a file or a bundled name, at x, y [m] and yaw [rad] (default: the "
        "origin, or next to what is there; repeatable)",
    )
    parser.add_argument(
        "--plugins",
        metavar="DIR",
        action="append",
        default=[],
        help="folder with Python modules of plugins that the file names (repeatable)",
    )
    parser.add_argument(
        "--system",
        metavar="MODULE:CLASS",
        action="append",
        default=[],
        help="also load a system plugin (repeatable)",
    )
    parser.add_argument(
        "--verbose", action="store_true", help="report why controllers are not started"
    )
    parser.set_defaults(parser=parser)


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    if args.paused and args.seconds is not None:
        args.parser.error("--for and --paused cannot be used together")
    if args.moveit and not args.ros:
        args.parser.error("--moveit requires --ros")
    if args.rosbridge is not None and not args.ros:
        args.parser.error("--rosbridge requires --ros")
    if args.wander and args.ros:
        args.parser.error("--wander and --ros cannot be used together")
    with announced(f"loading {args.file}"):
        sim = _built(args)
    with sim:
        for plugin in args.system:
            sim.load_plugin(plugin)
        remarks = [spawn(sim, robot) for robot in args.spawn]
        start_requested_controllers(sim, args)
        step = f"step {1000 * sim.engine.time_step:g} ms"
        sys.stdout.write(f"world '{sim.world.name}' ({args.engine}, {step}): {_listed(sim)}\n")
        sys.stdout.writelines(f"{line}\n" for line in remarks if line)
        say(_undriven(sim, args))
        with viewing(sim, args) as page:
            return _serve(sim, args, page) if args.ros else go(sim, args, page)


def _built(args: argparse.Namespace) -> Simulation:
    """Load the file, and return a simulation of it."""
    from gazelle import formats
    from gazelle.stage import stage_world

    sys.path[:0] = args.plugins
    world = formats.open_world(args.file, ground=args.ground)
    stage = stage_world(world)
    _take_from_file(args, stage)
    controller = "wander" if args.wander else "rounds" if _makes_rounds(world, args) else None
    if controller is not None:
        from gazelle.stage import with_wander

        world = with_wander(world, controller)
    if args.ros:
        from gazelle.bridges import refuse_twin

        refuse_twin("stageros" if stage and args.engine == "planar" else "gazebo")
    from gazelle.simulation import Simulation

    return Simulation(world, args.engine, seed=args.seed)


def _take_from_file(args: argparse.Namespace, stage: StageWorld | None) -> None:
    """Set engine, pace, pause and end from a Stage file, unless options set them."""
    if stage is None:
        args.engine, args.rate = args.engine or "mujoco", _pace(args.rate, 1.0)
        return
    args.engine, args.rate = args.engine or "planar", _pace(args.rate, stage.speedup)
    if args.seconds is None and not args.paused and stage.quit_time > 0.0:
        args.seconds = stage.quit_time


def _makes_rounds(world: World, args: argparse.Namespace) -> bool:
    """Return whether a page shows more robots of a Stage file than anyone drives by hand."""
    if args.view is None or args.ros or args.engine != "planar" or world.kind != "stage":
        return False
    return len(world.models) > _MANY


def _undriven(sim: Simulation, args: argparse.Namespace) -> str:
    """Return a hint at how to move the robots of a Stage file if nothing does, else ""."""
    from gazelle.stage import StageFleet

    fleet = sim.extension(StageFleet)
    if fleet is None or args.ros or not fleet.robots:
        return ""
    if fleet.controllers:
        rounds = not args.wander and _makes_rounds(sim.world, args)
        return "the robots drive in a round; --wander lets them roam\n" if rounds else ""
    view = "" if args.view is None else ", or the page"
    return f"nothing drives the robots: --wander does, or --ros with cmd_vel{view}\n"


def _listed(sim: Simulation) -> str:
    """Return the models, or their number if they are many."""
    names = list(sim.robots)
    return ", ".join(names) or "no models" if len(names) <= _MANY else f"{len(names)} models"


def go(sim: Simulation, args: argparse.Namespace, page: str = "") -> int:
    """Run until the end of the time, or Ctrl-C, by ``seconds``, ``rate`` and ``paused``.

    Args:
        sim: Simulation.
        args: Of the command line.
        page: Line with the address of the page, printed first.
    """
    say(page)
    status = _Status(sim)
    sim.physics.update_rate = (args.rate or 0.0) / sim.physics.time_step
    try:
        if args.paused:
            sim.pause()
            sys.stderr.write("paused; Ctrl-C ends it\n")
        _advance(sim, args.seconds, status)
    finally:
        status.show(final=True)
    return 0


class _Status:
    """A line with simulated time and real-time factor, rewritten in place on a terminal."""

    def __init__(self, sim: Simulation) -> None:
        self._sim = sim
        self._live = sys.stderr.isatty()
        self._start = time.monotonic()
        self._last = self._start

    def show(self, *, final: bool = False) -> None:
        """Show the status if it is time to, or if it is the last one."""
        now = time.monotonic()
        if not final and (not self._live or now - self._last < _STATUS_EVERY):
            return
        self._last = now
        wall = now - self._start
        factor = self._sim.time / wall if wall > 0 else 0.0
        text = f"simulated {self._sim.time:.2f} s in {wall:.2f} s, RTF {factor:.2f}"
        end = "\n" if final else ""
        sys.stderr.write(f"\r{text:<60}{end}" if self._live else f"{text}\n")
        sys.stderr.flush()


def _advance(sim: Simulation, seconds: float | None, status: _Status) -> None:
    """Step in slices of wall time, so that the status, a change of pace and Ctrl-C are prompt."""
    end = float("inf") if seconds is None else seconds
    piece = _SLICE
    while end - sim.time > 0.5 * (least := sim.clock.step_ns / 1e9):
        if _paused(sim):
            time.sleep(_SLICE)
            continue
        rate, began = sim.physics.target_rate, time.monotonic()
        if rate is not None:
            piece = _SLICE * rate
        try:
            sim.run(max(min(piece, end - sim.time), least), rate=rate)
        except SimulationError:
            if not _paused(sim):  # else it was paused just now
                raise
            continue
        if rate is None:
            took = max(time.monotonic() - began, 1e-4)
            piece = min(max(piece * _SLICE / took, least), 2 * piece)
        status.show()


def _serve(sim: Simulation, args: argparse.Namespace, page: str) -> int:
    """Serve as a ROS node until Ctrl-C, the end of the time, or a request of the master."""
    from gazelle.bridges import serve_ros
    from gazelle.stage import StageFleet
    from gazelle.stage.bridge import serve_stage

    if args.paused:
        sim.pause()
    if sim.extension(StageFleet) is not None:
        with serve_stage(sim, rate=args.rate) as stage, running_rosbridge(stage, args):
            if sim.paused:
                sys.stderr.write("paused; the service /gazelle/unpause starts it\n")
            return _attend(sim, stage, args, page)
    sim.physics.update_rate = (args.rate or 0.0) / sim.physics.time_step
    with (
        serve_ros(sim) as server,
        publishing_descriptions(sim, server),
        running_moveit(sim, server, args),
        running_rosbridge(server, args),
    ):
        return _attend(sim, server, args, page)


def _attend(
    sim: Simulation, server: RosServer | StageServer, args: argparse.Namespace, page: str
) -> int:
    say(f"ROS node {server.node.name} on {server.master_uri}\n{page}")
    status = _Status(sim)
    try:
        server.run(args.seconds)
    finally:
        status.show(final=True)
    return 0


def _paused(sim: Simulation) -> bool:
    """Return whether it is paused, which another thread may change."""
    return sim.paused


def _rate(text: str) -> float:
    """Return a real-time factor, infinite for ``max``."""
    return math.inf if text == "max" else positive_float(text)


def _pace(requested: float | None, usual: float) -> float | None:
    """Return the real-time factor to keep, None for as fast as possible."""
    rate = requested or (usual if usual > 0.0 else math.inf)
    return None if rate == math.inf else rate
