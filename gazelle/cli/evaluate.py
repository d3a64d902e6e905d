"""Evaluate the policy of a run: count the outcomes of its episodes.

  gazelle eval runs/TurtleBot3Stage1-ppo-20261105-140302 --episodes 1000
  gazelle eval RUN --failures failures.csv --failures failures.png
  gazelle eval RUN --goals published --starts published
  gazelle eval RUN --view            # then replay its episodes, failures first

Navigation tasks are evaluated on starts, goals and positions of obstacles that
no policy was trained on, unless you ask for others. Each environment runs
a number of episodes fixed in advance, so short episodes are not favoured.
Confidence intervals are at 95 %; repeated episodes widen them.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from gazelle.cli import showing
from gazelle.cli.episode_replay import show_episodes
from gazelle.cli.failures import failures_file, save_failures
from gazelle.cli.viewing import add_view
from gazelle_ros.base.argument_types import positive_int
from gazelle_ros.cli.parsing import (
    add_environment_options,
    add_file_options,
    add_import_option,
    add_scenario_options,
    add_worker_options,
    environment_options,
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("run", metavar="RUN", type=Path, help="run folder, or a policy.npz")
    parser.add_argument("--task", metavar="TASK", help="evaluate on another task")
    parser.add_argument(
        "--episodes",
        metavar="N",
        type=positive_int,
        default=100,
        help="number of episodes (default 100)",
    )
    parser.add_argument(
        "--num-envs", metavar="N", type=positive_int, help="number of parallel environments"
    )
    parser.add_argument(
        "--seed", metavar="N", type=int, default=10_000, help="seed of the goals (default 10000)"
    )
    parser.add_argument(
        "--failures",
        metavar="FILE",
        type=failures_file,
        action="append",
        default=[],
        help="save the failed episodes to a .json or .csv file, or a .png picture (repeatable)",
    )
    parser.add_argument(
        "--best", action="store_true", help="use the best policy of the run instead of the latest"
    )
    add_view(
        parser,
        "then play the episodes again on a page in a browser on this machine, one by one, failures "
        "first; its address is printed",
    )
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
    add_worker_options(parser, "number of processes that run the episodes")
    add_import_option(parser)
    add_file_options(parser)
    add_scenario_options(parser)
    add_environment_options(parser)
    parser.set_defaults(parser=parser)


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    if args.view is not None:
        if args.json or args.workers is not None or args.ray is not None:
            args.parser.error("--view cannot be used with --json, --workers or --ray")
        from gazelle.viewer.page.server import required_viser

        required_viser()
    from gazelle.training import evaluate

    result = evaluate(
        args.run,
        episodes=args.episodes,
        seed=args.seed,
        task=args.task,
        num_envs=args.num_envs,
        imports=args.imports,
        trust=args.trust,
        best=args.best,
        workers=args.workers,
        ray=args.ray,
        **environment_options(args),
    )
    for file in args.failures:
        save_failures(result, file)
    if args.json:
        sys.stdout.write(json.dumps(result.to_dict(), indent=2) + "\n")
        return 0
    sys.stdout.write(
        f"{result.task}, {result.episodes} episodes ({result.distinct} distinct), "
        f"seed {result.seed}\n{showing.evaluation(result)}"
    )
    for file in args.failures:
        sys.stdout.write(f"the {len(result.failures)} that failed are in {file}\n")
    if args.view is not None:
        show_episodes(result, args.view)
    return 0
