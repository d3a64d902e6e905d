"""Success rates that recipes reach: train, evaluate, and write them to the published figures.

Each claim of gazelle/training/claims.yaml is measured by its own commands, with ``--seed`` of the
training: on starts, headings, goals and phases of obstacles that no policy was trained on. Rates
are percentages of goals tried; 'one more seed' is the interval in which the rate of a training with
another seed lies with a probability of 95 %.

  gazelle bench recipes                            # the TurtleBot3 stages
  gazelle bench recipes --tasks Husarion UR5Reach
  gazelle bench recipes --algo sac --tasks TurtleBot3Stage4Continuous
  gazelle bench recipes --tasks all --write        # goes on where it was broken off
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from _campaign import Campaign, record, seeds_since
from _checkout import clean_commit, commit
from _claim_table import table

from gazelle.training import find_task, recipe_for
from gazelle.training.claims import CLAIMS_FILE, Claim, Trial, read_claims, training_command

_STAGES = tuple(f"TurtleBot3Stage{stage}" for stage in (1, 2, 3, 4))
_EPISODES = {"planar": 1000, "mujoco": 300}


def selected(tasks: Sequence[str], algo: str | None, engines: Sequence[str]) -> list[Claim]:
    """Return the claims to measure, those of one training together, the quickest first."""
    published = read_claims().claims
    if list(tasks) == ["all"]:
        found = list(published)
    else:
        found = []
        for task in tasks:
            train = training_command(task, algo)
            found += [each for each in published if each.train == train] or [new(task, algo)]
    if engines:
        found = [each for each in found if each.engine in engines]
    return sorted(found, key=lambda claim: (claim.cpu or 1e3, claim.train))


def new(task: str, algo: str | None) -> Claim:
    """Return a claim of a training that has none yet."""
    find_task(task)
    recipe = recipe_for(task, algo)
    engine = str(recipe.training_options.get("engine", "mujoco"))
    return Claim(
        task=task,
        algo=recipe.algo,
        engine=engine,
        train=training_command(task, algo),
        evaluate=f"gazelle eval RUN --engine {engine} --episodes {_EPISODES.get(engine, 300)}",
    )


def measured(args: argparse.Namespace, out: Path) -> list[Claim]:
    """Measure claims, and write each trial into the data file if that is asked for."""
    claims = selected(args.tasks, args.algo, args.engines)
    now = clean_commit() if args.write else commit()
    oldest = args.since or now
    done = {claim.key: seeds_since(claim, oldest) for claim in claims} if args.write else {}
    found = {claim.key: replace(claim, trials=()) for claim in claims}
    campaign = Campaign(seeds=args.seeds, commit=now, out=out, keep=args.out is not None)
    for claim, trial in campaign.results(claims, done):
        show(claim, trial)
        found[claim.key] = found[claim.key].with_trial(trial)
        if args.write:
            record(CLAIMS_FILE, claim, trial, args.seeds, oldest)
    if args.write:
        return [claim for claim in read_claims().claims if claim.key in found]
    return list(found.values())


def show(claim: Claim, trial: Trial) -> None:
    """Report one trial as soon as it is known."""
    sys.stderr.write(
        f"{claim.train} --seed {trial.seed}: {trial.success} of {trial.attempts} "
        f"({claim.engine}, {claim.goals}), {trial.cpu:.0f} s of processor time\n"
    )


def main() -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(
        prog="gazelle bench recipes",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--tasks", nargs="+", default=_STAGES, metavar="TASK", help="or all that have a figure"
    )
    parser.add_argument("--algo", help="by default that of the task's recipe")
    parser.add_argument("--engines", nargs="+", default=[], help="by default all of the task")
    parser.add_argument("--seeds", type=int, nargs="+", default=[0, 1, 2], help="of the training")
    parser.add_argument("--out", type=Path, help="where runs are kept, and found again")
    parser.add_argument(
        "--write", action="store_true", help="write what is measured to the published figures"
    )
    parser.add_argument(
        "--since",
        metavar="COMMIT",
        help="with --write: leave alone what was measured at this commit or later (default: now)",
    )
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as spare:
        found = measured(args, args.out or Path(spare))
    print(table(found), end="")


if __name__ == "__main__":
    main()
