"""Let the policy of a run act at its best and count how its episodes end.

  gazelle eval runs/TurtleBot3Stage1-ppo-20261105-140302 --episodes 1000

Every copy of the world runs a number of episodes fixed in advance, so short
episodes are not favoured. Intervals are Wilson's, at 95 %.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from gazelle.argument_types import positive_int
from gazelle.cli import showing
from gazelle.cli.parsing import add_environment_options, add_file_options, environment_options


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("run", metavar="RUN", type=Path, help="folder of a run, or a policy.npz")
    parser.add_argument("--task", metavar="TASK", help="another task than the run's")
    parser.add_argument(
        "--episodes", metavar="N", type=positive_int, default=100, help="how many (default 100)"
    )
    parser.add_argument("--num-envs", metavar="N", type=positive_int, help="copies at once")
    parser.add_argument(
        "--seed", metavar="N", type=int, default=10_000, help="seed of the goals (default 10000)"
    )
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
    add_file_options(parser)
    add_environment_options(parser)


def run(args: argparse.Namespace) -> int:
    """Do it; returns the exit code."""
    from gazelle.training import evaluate

    result = evaluate(
        args.run,
        episodes=args.episodes,
        seed=args.seed,
        task=args.task,
        num_envs=args.num_envs,
        **environment_options(args),
    )
    if args.json:
        sys.stdout.write(json.dumps(result.to_dict(), indent=2) + "\n")
    else:
        sys.stdout.write(f"{result.task}, {result.episodes} episodes, seed {result.seed}\n")
        sys.stdout.write(showing.evaluation(result))
    return 0
