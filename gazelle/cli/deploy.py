"""Drive a robot on a ROS 1 graph with a trained policy: in Gazelle, in Gazebo, or
a real TurtleBot3. Needs no torch.

  gazelle run turtlebot3_stage_1 --ros --spawn turtlebot3_burger
  gazelle deploy runs/TurtleBot3Stage1-ppo-20261105-140302 --arm --goal 1,0.5
  gazelle deploy policy.npz --max-linear 0.1 --log drive.jsonl odom:=/tb3/odom

The node subscribes to scan, odom and move_base_simple/goal, and publishes
cmd_vel; all names can be remapped. The robot stands still until the service
/gazelle_policy/arm is called:

  gazelle service call /gazelle_policy/arm "data: true"

A separate guard process publishes zero velocity when the node ends, even by
kill -9. With --goal or --goals the command exits when all goals are done, with
exit code 1 if one was not reached.
"""  # noqa: D205  # this is the text of --help

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from gazelle_ros.base.argument_types import positive_float
from gazelle_ros.cli.parsing import Parser, add_import_option

if TYPE_CHECKING:
    from gazelle.training.deploy import GoalPlace, GoalResult, Policy, SafetyLimits


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    if isinstance(parser, Parser):
        parser.intermixed = True
    parser.add_argument(
        "policy", metavar="RUN|FILE", type=Path, help="run folder, .npz or .onnx file"
    )
    parser.add_argument(
        "names",
        metavar="OLD:=NEW",
        nargs="*",
        help="remapping of a ROS name, such as scan:=/lidar (repeatable)",
    )
    goals = parser.add_argument_group("goals")
    goals.add_argument(
        "--goal",
        metavar="X,Y",
        action="append",
        default=[],
        help="position to drive to [m] (repeatable)",
    )
    goals.add_argument(
        "--goals", metavar="FILE", type=Path, help="file of goals, one x, y per line [m]"
    )
    goals.add_argument(
        "--time-limit",
        metavar="S",
        type=positive_float,
        help="time limit for each goal (default: that of the task)",
    )
    safety = parser.add_argument_group("safety")
    safety.add_argument(
        "--arm",
        action="store_true",
        help="arm without the service call, once all sensors have data",
    )
    safety.add_argument(
        "--max-linear",
        metavar="M/S",
        type=positive_float,
        default=math.inf,
        help="speed limit (default: none)",
    )
    safety.add_argument(
        "--max-angular",
        metavar="RAD/S",
        type=positive_float,
        default=math.inf,
        help="turn rate limit (default: none)",
    )
    safety.add_argument(
        "--stop-distance",
        metavar="M",
        type=float,
        help="only turn while an obstacle ahead is nearer than this; 0 disables it (default: the "
        "collision range of the task plus 0.03)",
    )
    safety.add_argument(
        "--scan-timeout",
        metavar="S",
        type=positive_float,
        default=0.4,
        help="stop if the last scan is older (default 0.4)",
    )
    safety.add_argument(
        "--odom-timeout",
        metavar="S",
        type=positive_float,
        default=0.4,
        help="stop if the last odometry is older (default 0.4)",
    )
    parser.add_argument(
        "--scan-yaw",
        metavar="RAD",
        type=float,
        default=0.0,
        help="yaw of the lidar relative to the robot, counter-clockwise [rad]",
    )
    parser.add_argument(
        "--log", metavar="FILE", type=Path, help="write a log of interventions (JSON lines)"
    )
    add_import_option(parser)
    parser.set_defaults(parser=parser)


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle.training.deploy import DeployNode, open_policy
    from gazelle_ros.base.interrupts import stopping
    from gazelle_ros.builtin.arguments import parse_arguments

    arguments = parse_arguments(args.names, "gazelle_policy")
    if arguments.plain:
        args.parser.error(f"unrecognized arguments: {' '.join(arguments.plain)}")
    goals = _goals(args)
    policy = open_policy(args.policy, imports=args.imports, trust=args.trust)
    limits = _limits(args, policy)
    with arguments.start() as node, stopping() as stop:
        deployed = DeployNode(
            node,
            policy,
            limits,
            turned=args.scan_yaw,
            time_limit=args.time_limit,
            log=args.log,
        )
        with deployed:
            sys.stderr.write(f"{policy.contract.task} on {node.name}, guarded\n")
            deployed.go_to(goals)
            deployed.run(stop, arm=args.arm, until_done=bool(goals))
            outcomes, overruled = deployed.pilot.outcomes, deployed.interventions.count
    return _report(outcomes, overruled, len(goals))


def _goals(args: argparse.Namespace) -> list[GoalPlace]:
    from gazelle.training.deploy import read_goals
    from gazelle.training.deploy.goals import parse_goal

    goals = []
    for text in args.goal:
        try:
            goals.append(parse_goal(text))
        except ValueError:
            args.parser.error(f"--goal {text}: expected X,Y in metres")
    return goals + ([] if args.goals is None else read_goals(args.goals))


def _limits(args: argparse.Namespace, policy: Policy) -> SafetyLimits:
    from gazelle.training.deploy import SafetyLimits

    distance = args.stop_distance
    if distance is None:
        distance = SafetyLimits.default_stop_distance(policy.contract)
    return SafetyLimits(
        max_linear=args.max_linear,
        max_angular=args.max_angular,
        stop_distance=distance,
        scan_timeout=args.scan_timeout,
        odometry_timeout=args.odom_timeout,
    )


def _report(outcomes: list[GoalResult], overruled: int, required: int) -> int:
    """Print the outcomes of goals; returns the exit code."""
    for each in outcomes:
        sys.stdout.write(
            f"({each.goal.x:g}, {each.goal.y:g})  {each.outcome}, {each.seconds:.1f} s\n"
        )
    reached = sum(each.outcome == "reached" for each in outcomes)
    if outcomes:
        sys.stdout.write(f"reached {reached} of {len(outcomes)}, overruled {overruled} times\n")
    return 0 if reached >= required else 1
