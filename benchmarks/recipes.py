"""What the default recipes of the TurtleBot3 stages learn: evaluated on held-out episodes.

Each stage is trained as `gazelle train TurtleBot3StageN` does, and evaluated in both engines:
on starts, headings, goals and phases of obstacles that no policy was trained on, and as
published. Rates are of episodes with one goal, with 95 % intervals.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from gazelle.training import Evaluation, Rate, Run, choose_progress, evaluate, train

_SCENARIOS = {
    "held-out": {},
    "published": {"goals": "published", "starts": "published"},
}


def trained(stage: int, out: Path, seed: int) -> Run:
    """The newest run of a stage that is there with all its steps, or a new one."""
    for folder in sorted(out.glob(f"TurtleBot3Stage{stage}-*"), reverse=True):
        run = Run.open(folder)
        done = [int(path.name) for path in run.checkpoints()]
        if done and done[-1] >= run.config.recipe.steps and run.config.seed == seed:
            return run
    task = f"TurtleBot3Stage{stage}"
    return train(task, out=out, seed=seed, progress=choose_progress(sys.stderr)).run


def line(stage: str, about: str, engine: str, scenario: str, found: Evaluation) -> str:
    """One row of the table."""
    rates = "".join(f"{share(rate):>26}" for rate in (found.success, found.collision))
    late = f"{found.timeout.value:8.1%}"
    return f"{stage:<7}{about:<20}{engine:<8}{scenario:<11}{found.distinct:>8}{rates}{late}"


def share(rate: Rate | None) -> str:
    """``91.2 % (88.4 to 93.4)``."""
    if rate is None:
        return "-"
    low, high = (100.0 * end for end in rate.interval)
    return f"{100.0 * rate.value:.1f} % ({low:.1f} to {high:.1f})"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--stages", type=int, nargs="+", default=[1, 2, 3, 4])
    parser.add_argument("--episodes", type=int, default=500)
    parser.add_argument("--seed", type=int, default=0, help="of the training")
    parser.add_argument("--out", type=Path, help="where runs are kept, and found again")
    args = parser.parse_args()
    print(f"default recipes, seed {args.seed}, {args.episodes} episodes a row")
    print(
        f"{'stage':<7}{'trained':<20}{'engine':<8}{'episodes':<11}{'distinct':>8}"
        f"{'success (95 %)':>26}{'collision (95 %)':>26}{'time-out':>9}"
    )
    with tempfile.TemporaryDirectory() as spare:
        for stage in args.stages:
            run = trained(stage, args.out or Path(spare), args.seed)
            engine = run.config.options.get("engine", "mujoco")
            about = f"{run.config.recipe.steps:,} {engine}"
            for judge in ("planar", "mujoco"):
                for name, options in _SCENARIOS.items():
                    found = evaluate(run.folder, episodes=args.episodes, engine=judge, **options)
                    print(line(str(stage), about, judge, name, found), flush=True)


if __name__ == "__main__":
    main()
