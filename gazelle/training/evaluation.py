"""Evaluation of policies: rates with intervals over a fixed number of episodes."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from gazelle.argument_checks import checked
from gazelle.envs.floor_plan import FloorPlan
from gazelle.errors import TaskError
from gazelle.training.actor import Actor, load_actor
from gazelle.training.evaluation_episodes import (
    EpisodesPlayed,
    EvaluationSetup,
    play_episodes,
    play_with_workers,
)
from gazelle.training.importing import TaskModule, load_all
from gazelle.training.records import EpisodeRecord, merged
from gazelle.training.runs import Run
from gazelle.training.statistics import SuccessRate
from gazelle.training.tasks import evaluation_options, fitting_copies
from gazelle.training.trust import require_trust
from gazelle.training.workers.shards import divided

_MOST_COPIES = 128


@dataclass(frozen=True, slots=True)
class Evaluation:
    """Result of an evaluation.

    Success, collision, time-out and other ends are shares of the goals that were tried, see
    `Episodes`: together they are 1. With one goal an episode they are shares of the episodes.
    """

    task: str
    """The task's id or name."""
    episodes: int
    """Number of episodes counted."""
    distinct: int
    """Number of different episodes: the others repeat one of these."""
    seed: int
    """Seed of the environment."""
    success: SuccessRate | None
    """Goals that were reached; None if unknown."""
    collision: SuccessRate | None
    """Attempts that ended in a collision; None if unknown."""
    timeout: SuccessRate
    """Attempts that ran out of time."""
    other: SuccessRate
    """Attempts that ended otherwise, such as by a fall."""
    mean_return: float
    """Mean sum of rewards of an episode."""
    mean_length: float
    """Mean control steps of an episode."""
    wall_seconds: float
    """Wall time of the evaluation, without building the environment [s]."""
    sim_seconds: float | None
    """Simulated time of all copies together [s]; None when the task has no control period."""
    records: tuple[EpisodeRecord, ...] = field(default=(), repr=False)
    """Each episode by itself."""
    floor_plan: FloorPlan | None = field(default=None, repr=False)
    """Obstacles of the world, seen from above; None if unknown."""
    setup: EvaluationSetup | None = field(default=None, repr=False)
    """Policy, task and options, to play episodes again; None if workers played them."""
    copies: int = 0
    """Copies of the environment; 0 if workers had them."""

    @property
    def rtf(self) -> float | None:
        """Simulated seconds per wall second."""
        return None if self.sim_seconds is None else self.sim_seconds / self.wall_seconds

    @property
    def failures(self) -> tuple[EpisodeRecord, ...]:
        """The episodes of which the last attempt failed."""
        return tuple(record for record in self.records if record.failed)

    def to_dict(self) -> dict[str, Any]:
        """Return plain values for JSON.

        Rates as ``{count, total, effective, value, low, high}``.
        """
        return {
            "task": self.task,
            "episodes": self.episodes,
            "distinct": self.distinct,
            "seed": self.seed,
            "success": _rate_to_dict(self.success),
            "collision": _rate_to_dict(self.collision),
            "timeout": _rate_to_dict(self.timeout),
            "other": _rate_to_dict(self.other),
            "mean_return": self.mean_return,
            "mean_length": self.mean_length,
            "wall_seconds": self.wall_seconds,
            "sim_seconds": self.sim_seconds,
            "rtf": self.rtf,
        }


@checked(TaskError)
def evaluate(
    run_or_policy: str | Path | Actor,
    *,
    episodes: int = 100,
    seed: int = 10_000,
    task: str | None = None,
    num_envs: int | None = None,
    imports: Sequence[str] = (),
    trust: bool = False,
    best: bool = False,
    workers: int | None = None,
    ray: str | None = None,
    **options: Any,
) -> Evaluation:
    """Run a policy without exploration and count the outcomes of its episodes.

    Every copy of the environment runs a number of episodes that is fixed in
    advance. (Taking the first episodes that end, from any copy, would favour
    the short ones.) Copies that share a world run one episode each, from a common start; for more
    of them all start again. Same policy, seed and number of copies: same result.

    A task says with which options it is evaluated, see `evaluation_options`; the bundled
    navigation tasks define starts and goals that no policy was trained on. Episodes that
    repeat others widen the intervals, see `clustered_rate`, and so do those in one world.

    Args:
        run_or_policy: Folder of a run, a ``policy.npz``, or an actor.
        episodes: Number of episodes to count; where copies share a world, more to fill the
            last world, so that each of them counts as often as the others.
        seed: Seed from which the environment's follows; see `evaluation_seed`. Trainings draw others.
        task: The task; needed unless a run names it.
        num_envs: Copies that run at once; by default one an episode, at most 128.
        imports: Modules or files to import first, which register the task.
        trust: Whether to import modules that the run names and ``imports`` does not.
        best: Of a run, take the best policy of the evaluations during the training.
        workers: Number of processes that play the episodes. The copies are divided among them with a seed
            each, by their number alone: any number of workers finds the same, but other episodes
            than without workers.
        ray: The workers are on the Ray cluster at this address, ``local`` for one on this machine.
        options: Options of the environment that differ from the run's, from the task's own for
            evaluations, and from its recipe's ``evaluation_options``.

    Raises:
        TaskError: A number is below 1, no task is given, the policy does not fit it, or the run
            names code that is not trusted.
        FormatError: The policy is damaged.
        MissingExtraError: Ray is requested and not installed.
    """
    if episodes < 1 or (num_envs is not None and num_envs < 1):
        raise TaskError("an evaluation needs at least 1 episode and 1 environment")
    modules = load_all(imports)
    actor, task, options = resolve_policy(
        run_or_policy, task, modules, options, best=best, trust=trust
    )
    unit = fitting_copies(task, 1, options)
    episodes = -(-episodes // unit) * unit
    copies = fitting_copies(task, min(episodes, num_envs or _MOST_COPIES), options)
    homes = modules or _homes(run_or_policy)
    setup = EvaluationSetup(actor=actor, task=task, options=options, imports=homes, together=unit)
    if workers is None and ray is None:
        played = play_episodes(setup, copies, episodes, seed)
        return _summed_up([played], task=task, seed=seed, setup=setup, copies=copies)
    start = time.perf_counter()
    parts = play_with_workers(setup, divided(copies, unit), episodes, seed, workers, ray)
    wall = time.perf_counter() - start
    summed = _summed_up(parts, task=task, seed=seed)
    records = tuple(replace(record, place=None) for record in summed.records)
    return replace(summed, wall_seconds=wall, records=records)


def _summed_up(parts: Sequence[EpisodesPlayed], **about: Any) -> Evaluation:
    """Combine the parts of an evaluation into one result."""
    ledger = merged([part.ledger for part in parts])
    times = [part.sim_seconds for part in parts if part.sim_seconds is not None]
    return Evaluation(
        floor_plan=parts[0].floor_plan,
        wall_seconds=sum(part.wall_seconds for part in parts),
        sim_seconds=sum(times) if times else None,
        episodes=len(ledger.records),
        distinct=ledger.distinct,
        success=ledger.rate("goals") if ledger.reports("is_success") else None,
        collision=ledger.rate("collisions") if ledger.reports("is_collision") else None,
        timeout=ledger.rate("timeouts"),
        other=ledger.rate("others"),
        mean_return=float(np.mean([record.sum_of_rewards for record in ledger.records])),
        mean_length=float(np.mean([record.length for record in ledger.records])),
        records=tuple(ledger.records),
        **about,
    )


def resolve_policy(
    run_or_policy: str | Path | Actor,
    task: str | None,
    modules: tuple[TaskModule, ...],
    options: dict[str, Any],
    *,
    best: bool = False,
    trust: bool = False,
) -> tuple[Actor, str, dict[str, Any]]:
    """Return the actor, its task, and the options of the environment."""
    chosen = {key: value for key, value in options.items() if value is not None}
    if isinstance(run_or_policy, str | Path) and Path(run_or_policy).suffix != ".npz":
        run = Run.open(Path(run_or_policy))
        require_trust(run, modules, trust=trust)
        if task is None:
            load_all(() if modules else run.config.imports)
            task = run.config.task
        trained = run.config.options
        known = run.config.recipe.evaluated(trained | evaluation_options(task, trained))
        return load_actor(run.policy_file(best=best)), task, known | chosen
    if task is None:
        raise TaskError("a policy file does not name its task", hint="give the task as well")
    options = evaluation_options(task, {}) | chosen
    if isinstance(run_or_policy, Actor):
        return run_or_policy, task, options
    return load_actor(Path(run_or_policy)), task, options


def _homes(run_or_policy: str | Path | Actor) -> tuple[TaskModule, ...]:
    """Return modules that register the task of a run."""
    if isinstance(run_or_policy, Actor) or Path(run_or_policy).suffix == ".npz":
        return ()
    return Run.open(Path(run_or_policy)).config.imports


def _rate_to_dict(rate: SuccessRate | None) -> dict[str, float] | None:
    if rate is None:
        return None
    low, high = rate.interval
    return {
        "count": rate.count,
        "total": rate.total,
        "effective": rate.total if rate.effective is None else rate.effective,
        "value": rate.value,
        "low": low,
        "high": high,
    }
