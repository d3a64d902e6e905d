"""Look at a file, or at the ROS graph that runs, live in a browser on this
machine.

  gazelle view my_robot.urdf.xacro       # its joints have sliders
  gazelle view turtlebot3_world
  gazelle view run.jsonl                 # a recording, with a time slider
  gazelle view                           # ROS_MASTER_URI's graph

A file stands still until it is started on the page. Of a graph the page shows
robots (robot_description and tf), scans, point clouds, maps, paths, poses,
markers and images, and has the tools of RViz and the panels of rqt.
"""  # noqa: D205  # this is the text of --help

from __future__ import annotations

import argparse
import time
from pathlib import Path

from gazelle.cli.grounding import add_ground
from gazelle.cli.run import go
from gazelle.cli.viewing import viewing
from gazelle_ros.base.argument_types import port_number
from gazelle_ros.base.output import say


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "file",
        metavar="FILE",
        nargs="?",
        help="world, robot or recording (default: the running ROS graph)",
    )
    parser.add_argument("--engine", metavar="NAME", help="physics engine: mujoco or planar")
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="random seed (default 0)")
    add_ground(parser)
    parser.add_argument(
        "--frame", metavar="NAME", help="fixed frame, for a ROS graph (default: map, odom ...)"
    )
    parser.add_argument(
        "--layout", metavar="NAME", help="saved page layout to open, for a ROS graph"
    )
    parser.add_argument(
        "--port",
        dest="view",
        metavar="PORT",
        type=port_number,
        default=0,
        help="port of the page (default: any free port)",
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    if args.file is None:
        return _graph(args)
    return _recording(args) if Path(args.file).suffix == ".jsonl" else _file(args)


def _file(args: argparse.Namespace) -> int:
    from gazelle import formats
    from gazelle.simulation import Simulation

    world = formats.open_world(args.file, ground=args.ground)
    engine = args.engine or ("planar" if world.kind == "stage" else "mujoco")
    args.seconds, args.rate, args.paused = None, 1.0, True
    with Simulation(world, engine, seed=args.seed) as sim, viewing(sim, args) as page:
        return go(sim, args, page)


def _recording(args: argparse.Namespace) -> int:
    from gazelle.simulation import Replay
    from gazelle.viewer import LiveView

    args.seconds, args.rate, args.paused = None, 1.0, True
    with Replay(args.file) as replay, LiveView(replay.simulation, port=args.view) as view:
        view.show_recording(replay)
        return go(replay.simulation, args, f"view {view.url}\n")


def _graph(args: argparse.Namespace) -> int:
    from gazelle.viewer.graph import GraphView

    with GraphView(frame=args.frame, port=args.view) as view:
        if args.layout:
            view.load_layout(args.layout)
        say(f"view {view.url}\n")
        while not view.ended:
            time.sleep(0.2)
    return 0
