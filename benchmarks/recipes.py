"""What the recipes of tasks learn, evaluated on held-out episodes: success, time, intervals.

Each task is trained as `gazelle tasks TASK` says, with `--seed S`, and evaluated in the engines
that it has figures of, on starts, headings, goals and phases of obstacles that no policy was
trained on. The TurtleBot3 stages are evaluated in both engines, with one goal an episode and with
goals one after the other, and as published. Rates are of goals that were tried, of all seeds
together, with 95 % intervals; beside them those of each seed.

  gazelle bench recipes                            # the TurtleBot3 stages
  gazelle bench recipes --tasks Husarion UR5Reach
  gazelle bench recipes --tasks all --seeds 0
  gazelle bench recipes --algo sac --tasks TurtleBot3Stage4Continuous
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from _busy import StopWatch

from gazelle.training import (
    VERIFIED,
    Evaluation,
    Run,
    SuccessRate,
    choose_progress,
    evaluate,
    recipe_for,
    train,
)

_STAGES = tuple(f"TurtleBot3Stage{stage}" for stage in (1, 2, 3, 4))

_SCENARIOS = {
    "held-out": {},
    "in a row": {"respawn": True},
    "published": {"goals": "published", "starts": "published"},
}
_SHARE = {"held-out": 1.0, "in a row": 0.1, "published": 0.5}
"""Of the episodes; one in which goals follow each other has some eight of them."""


def trained(task: str, algo: str | None, out: Path, seed: int) -> Run:
    """The newest run of a task that is there with all its steps, or a new one."""
    for folder in sorted(out.glob(f"{task}-{algo or recipe_for(task).algo}-*"), reverse=True):
        run = Run.open(folder)
        done = [int(path.name) for path in run.checkpoints()]
        if done and done[-1] >= run.config.recipe.steps and run.config.seed == seed:
            return run
    watch = StopWatch()
    result = train(task, algo=algo, out=out, seed=seed, progress=choose_progress(sys.stderr))
    print(f"{task}, seed {seed}: {watch.read()}", flush=True)
    return result.run


def engines_of(task: str) -> list[str]:
    """Where a task is evaluated."""
    if task in _STAGES:
        return ["planar", "mujoco"]
    return list(VERIFIED[task].success) if task in VERIFIED else []


def scenarios_of(task: str) -> list[str]:
    """With which starts and goals."""
    return list(_SCENARIOS) if task in _STAGES else ["held-out"]


def line(task: str, engine: str, scenario: str, found: list[Evaluation]) -> str:
    """One row of the table."""
    seeds = " ".join(f"{each.success.value:6.1%}" if each.success else "-" for each in found)
    rates = "".join(
        f"{share([getattr(each, name) for each in found]):>26}" for name in ("success", "collision")
    )
    late = sum(each.timeout.count for each in found) / sum(each.timeout.total for each in found)
    tried = sum(each.timeout.total for each in found)
    return f"{task:<27}{engine:<8}{scenario:<10}{tried:>7}  {seeds}{rates}{late:9.1%}"


def share(rates: list[SuccessRate | None]) -> str:
    """All of them together: ``91.2 % (88.4 to 93.4)``."""
    told = [rate for rate in rates if rate is not None]
    if not told:
        return "-"
    effective = sum(rate.total if rate.effective is None else rate.effective for rate in told)
    count, total = sum(rate.count for rate in told), sum(rate.total for rate in told)
    low, high = (100.0 * end for end in SuccessRate(count, total, effective).interval)
    return f"{100.0 * count / total:.1f} % ({low:.1f} to {high:.1f})"


def main() -> None:
    parser = argparse.ArgumentParser(
        prog="gazelle bench recipes",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--tasks", nargs="+", default=_STAGES, metavar="TASK", help="or all that have a figure"
    )
    parser.add_argument("--algo", help="by default that of the task's recipe")
    parser.add_argument("--engines", nargs="+", help="by default those of the task")
    parser.add_argument("--episodes", type=int, default=1000, help="of each seed")
    parser.add_argument("--seeds", type=int, nargs="+", default=[0, 1, 2], help="of the training")
    parser.add_argument("--out", type=Path, help="where runs are kept, and found again")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as spare:
        out = args.out or Path(spare)
        tasks = list(VERIFIED) if list(args.tasks) == ["all"] else args.tasks
        runs = {
            task: [trained(task, args.algo, out, seed) for seed in args.seeds] for task in tasks
        }
        print(f"default recipes, seeds {args.seeds}, {args.episodes} episodes of each")
        print(
            f"{'task':<27}{'engine':<8}{'goals':<10}{'tried':>7}  "
            f"{'of each seed':<{7 * len(args.seeds) - 1}}"
            f"{'success (95 %)':>26}{'collision (95 %)':>26}{'time-out':>9}"
        )
        for task, found in runs.items():
            for engine in args.engines or engines_of(task) or [found[0].config.options["engine"]]:
                for name in scenarios_of(task):
                    count = max(1, round(_SHARE[name] * args.episodes))
                    results = [
                        evaluate(run.folder, episodes=count, engine=engine, **_SCENARIOS[name])
                        for run in found
                    ]
                    print(line(task, engine, name, results), flush=True)


if __name__ == "__main__":
    main()
