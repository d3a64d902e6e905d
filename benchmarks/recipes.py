"""What the default recipes of the TurtleBot3 stages learn: evaluated on held-out episodes.

Each stage is trained as `gazelle train TurtleBot3StageN --seed S` does, and evaluated in both
engines: on starts, headings, goals and phases of obstacles that no policy was trained on, with
one goal an episode and with goals one after the other, and as published. Rates are of goals
that were tried, of all seeds together, with 95 % intervals; beside them those of each seed.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path

from gazelle.training import Evaluation, Run, SuccessRate, choose_progress, evaluate, train

_SCENARIOS = {
    "held-out": {},
    "in a row": {"respawn": True},
    "published": {"goals": "published", "starts": "published"},
}
_SHARE = {"held-out": 1.0, "in a row": 0.1, "published": 0.5}
"""Of the episodes; one in which goals follow each other has some eight of them."""


def trained(stage: int, out: Path, seed: int) -> Run:
    """The newest run of a stage that is there with all its steps, or a new one."""
    task = f"TurtleBot3Stage{stage}"
    for folder in sorted(out.glob(f"{task}-*"), reverse=True):
        run = Run.open(folder)
        done = [int(path.name) for path in run.checkpoints()]
        if done and done[-1] >= run.config.recipe.steps and run.config.seed == seed:
            return run
    before = time.process_time()
    result = train(task, out=out, seed=seed, progress=choose_progress(sys.stderr))
    spent = time.process_time() - before
    print(f"stage {stage}, seed {seed}: {result.wall_seconds:.0f} s, of processors {spent:.0f} s")
    return result.run


def line(stage: int, engine: str, scenario: str, found: list[Evaluation]) -> str:
    """One row of the table."""
    seeds = " ".join(f"{each.success.value:6.1%}" if each.success else "-" for each in found)
    rates = "".join(
        f"{share([getattr(each, name) for each in found]):>26}" for name in ("success", "collision")
    )
    late = sum(each.timeout.count for each in found) / sum(each.timeout.total for each in found)
    tried = sum(each.timeout.total for each in found)
    return f"{stage:<6}{engine:<8}{scenario:<10}{tried:>7}  {seeds}{rates}{late:9.1%}"


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
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--stages", type=int, nargs="+", default=[1, 2, 3, 4])
    parser.add_argument("--engines", nargs="+", default=["planar", "mujoco"])
    parser.add_argument("--episodes", type=int, default=1000, help="of each seed")
    parser.add_argument("--seeds", type=int, nargs="+", default=[0, 1, 2], help="of the training")
    parser.add_argument("--out", type=Path, help="where runs are kept, and found again")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as spare:
        out = args.out or Path(spare)
        runs = {stage: [trained(stage, out, seed) for seed in args.seeds] for stage in args.stages}
        print(f"default recipes, seeds {args.seeds}, {args.episodes} episodes of each")
        print(
            f"{'stage':<6}{'engine':<8}{'goals':<10}{'tried':>7}  "
            f"{'of each seed':<{7 * len(args.seeds) - 1}}"
            f"{'success (95 %)':>26}{'collision (95 %)':>26}{'time-out':>9}"
        )
        for stage, found in runs.items():
            for engine in args.engines:
                for name, options in _SCENARIOS.items():
                    count = max(1, round(_SHARE[name] * args.episodes))
                    results = [
                        evaluate(run.folder, episodes=count, engine=engine, **options)
                        for run in found
                    ]
                    print(line(stage, engine, name, results), flush=True)


if __name__ == "__main__":
    main()
