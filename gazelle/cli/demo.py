"""Run the main workflow: load, train and evaluate a TurtleBot3 burger.

It loads the robot and a world from their files, trains a policy in parallel
environments, and evaluates it on 100 new goals.

  gazelle demo
  gazelle demo --world my.world --robot my_burger.urdf.xacro
"""  # this is the text of --help

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from typing import Any

from gazelle.cli import showing
from gazelle.cli.train import report
from gazelle.cli.viewing import COPIES, add_view, watched
from gazelle_ros.base.argument_types import positive_int
from gazelle_ros.base.output import say
from gazelle_ros.cli.parsing import (
    add_environment_options,
    add_file_options,
    add_scenario_options,
    environment_options,
)

_TASK = "TurtleBot3Stage1"
_WORLD = "turtlebot3_stage_1"
_ROBOT = "turtlebot3_burger"


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "--steps", metavar="N", type=positive_int, help="total number of environment steps"
    )
    parser.add_argument(
        "--num-envs", metavar="N", type=positive_int, help="number of parallel environments"
    )
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="random seed (default 0)")
    parser.add_argument(
        "--episodes",
        metavar="N",
        type=positive_int,
        default=100,
        help="number of evaluation episodes (default 100)",
    )
    parser.add_argument(
        "--out",
        metavar="DIR",
        type=Path,
        default=Path("runs"),
        help="parent folder of the run (default runs)",
    )
    add_view(parser, COPIES)
    add_file_options(parser)
    add_scenario_options(parser)
    add_environment_options(parser)


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    began = time.perf_counter()
    from gazelle.training import choose_progress, evaluate, train

    options = environment_options(args)
    _print_files(options)
    result = train(
        _TASK,
        steps=args.steps,
        num_envs=args.num_envs,
        seed=args.seed,
        out=args.out,
        progress=watched(choose_progress(), args),
        **options,
    )
    if result.interrupted:
        return report(result)
    sys.stdout.write(f"trained:  {showing.training(result, indent=10)}\n")
    folder = result.run.folder
    again = showing.program()
    requested = {name: options[name] for name in ("goals", "starts") if name in options}
    found = evaluate(folder, episodes=args.episodes, seed=args.seed + 10_000, **requested)
    sys.stdout.write(f"evaluated on {found.episodes} fresh goals:\n{showing.evaluation(found)}")
    sys.stdout.write(
        f"in all {time.perf_counter() - began:.0f} s; the run's files are in {folder}\n"
        "next:\n"
        f"  {again} eval {folder} --episodes 1000\n"
        f"  {again} train TurtleBot3Stage4\n"
        f"  {again} run turtlebot3_stage_1 --for 10\n"
    )
    return 0


def _print_files(options: dict[str, Any]) -> None:
    """Print the files that are loaded."""
    from gazelle import assets

    world = _file(options.get("world", _WORLD), assets.worlds())
    robot = _file(options.get("robot", _ROBOT), assets.robots())
    say(f"world:    {world}\nrobot:    {robot}\n")


def _file(name: str, bundled: dict[str, Path]) -> str:
    """Return the file of a name or path."""
    return str(bundled.get(name, name))
