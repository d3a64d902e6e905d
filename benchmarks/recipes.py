"""Success rates that recipes reach: train, evaluate, and write them to the published figures.

Each claim of gazelle/training/claims.yaml is measured by its own commands, with ``--seed`` of the
training: on starts, headings, goals and phases of obstacles that no policy was trained on. Rates
are percentages of goals tried; 'one more seed' is the interval in which the rate of a training with
another seed lies with a probability of 95 %.

  gazelle bench recipes                            # the TurtleBot3 stages
  gazelle bench recipes --tasks Husarion UR5Reach
  gazelle bench recipes --tasks "TurtleBot3Stage4Continuous --algo sac"
  gazelle bench recipes --tasks examples/dock.py:my/Dock-v0      # any task of a file
  gazelle bench recipes --tasks all --write        # goes on where it was broken off
  gazelle bench recipes --verify --cheap           # does today's code reach what is published?
"""

from __future__ import annotations

import argparse
import math
import shlex
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from _campaign import Campaign, record, seeds_since, take
from _checkout import clean_commit, commit, commits
from _claim_table import table
from _verify import CHEAP, seed_of, verify, within, worth_verifying

from gazelle.cli import train as train_command
from gazelle.training import make_task, task_recipe
from gazelle.training.claims import CLAIMS_FILE, Claim, Trial, read_claims
from gazelle.training.recipes import task_name
from gazelle.training.tasks import env_attribute, split_module
from gazelle_ros.cli.parsing import Parser

_STAGES = tuple(f"TurtleBot3Stage{stage}" for stage in (1, 2, 3, 4))
_SEEDS = (0, 1, 2)
_EPISODES = {"planar": 1000, "mujoco": 300}


def selected(tasks: Sequence[str], engines: Sequence[str]) -> list[Claim]:
    """Return the claims to measure, the quickest training first.

    Args:
        tasks: What stands behind ``gazelle train``, or ``all`` that is published.
        engines: Engines of evaluations; none for all.
    """
    published = read_claims().claims
    trains = [f"gazelle train {task}" for task in tasks]
    found = [each for each in published if list(tasks) == ["all"] or each.train in trains]
    known = {claim.train for claim in found}
    if list(tasks) != ["all"]:
        found += [new(train) for train in trains if train not in known]
    costs: dict[str, float] = {}
    for claim in found:
        costs[claim.train] = max(costs.get(claim.train, 0.0), claim.cpu or 0.0)
    chosen = [each for each in found if not engines or each.engine in engines]
    return sorted(chosen, key=lambda claim: (costs[claim.train] or math.inf, claim.train))


def new(train: str) -> Claim:
    """Return a claim of a training that has none yet."""
    args = command_arguments(train)
    recipe = task_recipe(args.task, args.algo)
    file, _ = split_module(args.task)
    engine = args.engine or recipe.training_options.get("engine")
    if file is not None:
        engine = engine or engine_of(args.task)
    engine = str(engine or "mujoco")
    options = [f"--engine {engine}"] if file is None or args.engine else []
    options += [] if file is None else [f"--import {shlex.quote(file)}"]
    return Claim(
        task=task_name(args.task),
        algo=recipe.algo,
        engine=engine,
        train=train,
        evaluate=f"gazelle eval RUN {' '.join(options)} --episodes {_EPISODES.get(engine, 300)}",
    )


def engine_of(task: str) -> str:
    """Return the engine that a user's task chooses itself."""
    env = make_task(task, 1)
    simulation = env_attribute(env, "task").simulation
    env.close()
    return str(simulation.engine_name)


def command_arguments(train: str) -> argparse.Namespace:
    """Parse a command that trains."""
    parser = Parser(prog="gazelle train")
    train_command.configure(parser)
    return parser.parse_args(shlex.split(train)[2:])


def measured(args: argparse.Namespace, out: Path) -> list[Claim]:
    """Measure claims, and write each trial into the data file if that is asked for."""
    claims = selected(args.tasks or _STAGES, args.engines)
    seeds = args.seeds or _SEEDS
    now = clean_commit() if args.write else commit()
    oldest = args.since or now
    done = {claim.key: seeds_since(claim, oldest) for claim in claims} if args.write else {}
    found = {claim.key: replace(claim, trials=()) for claim in claims}
    campaign = Campaign(seeds=seeds, commit=now, out=out, keep=args.out is not None)
    for claim, trial in campaign.results(claims, done):
        show(claim, trial)
        found[claim.key] = found[claim.key].with_trial(trial)
        if args.write:
            record(CLAIMS_FILE, claim, trial, seeds, oldest)
    if args.write:
        return [claim for claim in read_claims().claims if claim.key in found]
    return list(found.values())


def show(claim: Claim, trial: Trial) -> None:
    """Report one trial as soon as it is known."""
    sys.stderr.write(
        f"{claim.train} --seed {trial.seed}: {trial.success} of {trial.attempts} "
        f"({claim.engine}, {claim.goals}), {trial.cpu:.0f} s of processor time\n"
    )


def verified(args: argparse.Namespace, out: Path) -> bool:
    """Train again and compare with what is published; return whether nothing falls below."""
    turn = commits()
    claims = worth_verifying(selected(args.tasks or ["all"], args.engines), cheap=args.cheap)
    if args.budget is not None:
        claims = within(claims, args.budget, turn)
    seeds = args.seeds or [seed_of(turn)]
    print(f"seed {' '.join(map(str, seeds))}; 'published' is the 95 % interval of one more seed")
    failed = verify(claims, seeds, out)
    for each in failed:
        print(f"falls below what is published, with two seeds: {each}")
    return not failed


def main() -> None:
    """Measure and print a table, or compare."""
    args = arguments()
    with tempfile.TemporaryDirectory() as spare:
        out = args.out or Path(spare)
        if args.verify:
            raise SystemExit(0 if verified(args, out) else 1)
        if args.take is not None:
            found = take(CLAIMS_FILE, args.take, args.since or commit())
        else:
            found = measured(args, out)
        print(table(found, long=True), end="")


def arguments() -> argparse.Namespace:
    """Parse the command line."""
    parser = argparse.ArgumentParser(
        prog="gazelle bench recipes",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add = parser.add_argument
    add(
        "--tasks",
        nargs="+",
        metavar="TASK",
        help="may have options, in quotes; 'all': all that are published",
    )
    add("--engines", nargs="+", default=[], help="by default all of the task")
    add("--seeds", type=int, nargs="+", help="of the training (default: 0 1 2)")
    add("--out", type=Path, help="where runs are kept, and found again")
    add("--write", action="store_true", help="write what is measured to the published figures")
    add(
        "--since",
        metavar="COMMIT",
        help="with --write: leave alone what was measured at this commit or later (default: now)",
    )
    add(
        "--take",
        type=Path,
        metavar="FILE",
        help="instead of measuring, enter what another checkout's claims.yaml has --since COMMIT",
    )
    add(
        "--verify",
        action="store_true",
        help="compare with what is published, all or TASKS, with a seed that "
        "depends on the number of commits; exit code 1 where one falls below",
    )
    add("--cheap", action="store_true", help=f"only trainings of less than {CHEAP:.0f} s")
    add(
        "--budget",
        type=float,
        metavar="SECONDS",
        help="only as many trainings as take this processor time, in turn",
    )
    args = parser.parse_args()
    if not args.verify and (args.cheap or args.budget is not None):
        parser.error("--cheap and --budget belong to --verify")
    return args


if __name__ == "__main__":
    main()
