"""How good is a policy: rates with intervals over a fixed number of episodes."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from gazelle.errors import TaskError
from gazelle.training.actor import Actor, load_actor
from gazelle.training.runs import Run
from gazelle.training.statistics import Rate
from gazelle.training.stepper import Episodes, Stepper
from gazelle.training.tasks import control_period, make_task

_MOST_COPIES = 128


@dataclass(frozen=True, slots=True)
class Evaluation:
    """What an evaluation found."""

    task: str
    """The task's id or name."""
    episodes: int
    """How many episodes were counted."""
    seed: int
    """Seed of the environment."""
    success: Rate | None
    """Episodes that reached their goal; None when the task does not tell."""
    collision: Rate | None
    """Episodes that ended in a collision; None when the task does not tell."""
    timeout: Rate
    """Episodes that ran out of time."""
    mean_return: float
    """Mean sum of rewards of an episode."""
    mean_length: float
    """Mean control steps of an episode."""
    wall_seconds: float
    """Wall time of the evaluation, without building the environment [s]."""
    sim_seconds: float | None
    """Simulated time of all copies together [s]; None when the task has no control period."""

    @property
    def rtf(self) -> float | None:
        """Simulated seconds per wall second."""
        return None if self.sim_seconds is None else self.sim_seconds / self.wall_seconds

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; rates as ``{count, total, value, low, high}``."""
        return {
            "task": self.task,
            "episodes": self.episodes,
            "seed": self.seed,
            "success": _rate_to_dict(self.success),
            "collision": _rate_to_dict(self.collision),
            "timeout": _rate_to_dict(self.timeout),
            "mean_return": self.mean_return,
            "mean_length": self.mean_length,
            "wall_seconds": self.wall_seconds,
            "sim_seconds": self.sim_seconds,
            "rtf": self.rtf,
        }


def evaluate(
    run_or_policy: str | Path | Actor,
    *,
    episodes: int = 100,
    seed: int = 10_000,
    task: str | None = None,
    num_envs: int | None = None,
    **options: Any,
) -> Evaluation:
    """Let a policy act at its best and count how its episodes end.

    Every copy of the environment runs a number of episodes that is fixed in
    advance. (Taking the first episodes that end, from any copy, would favour
    the short ones.) Same policy, seed and number of copies: same result.

    Args:
        run_or_policy: Folder of a run, a ``policy.npz``, or an actor.
        episodes: How many episodes to count.
        seed: Seed of the environment.
        task: The task; needed unless a run tells it.
        num_envs: Copies that run at once; by default one an episode, at most 128.
        options: Options of the environment that differ from the run's and from its
            recipe's ``evaluation_options``.

    Raises:
        TaskError: A number is below 1, no task is given, or the policy does not fit it.
        FormatError: The policy is damaged.
    """
    if episodes < 1 or (num_envs is not None and num_envs < 1):
        raise TaskError("an evaluation needs at least 1 episode and 1 environment")
    actor, task, options = _resolve(run_or_policy, task, options)
    copies = min(episodes, num_envs or _MOST_COPIES)
    env = make_task(task, copies, **options)
    try:
        period = control_period(env)
        counter = _Counter(episodes, copies)
        start = time.perf_counter()
        steps = _play(actor, Stepper(env), counter, seed)
        wall = time.perf_counter() - start
    finally:
        env.close()
    return Evaluation(
        task=task,
        episodes=episodes,
        seed=seed,
        success=counter.rate("is_success"),
        collision=counter.rate("is_collision"),
        timeout=counter.rate("is_timeout") or Rate(counter.truncated, episodes),
        mean_return=counter.sum_of_returns / episodes,
        mean_length=counter.sum_of_lengths / episodes,
        wall_seconds=wall,
        sim_seconds=None if period is None else steps * copies * period,
    )


class _Counter:
    """Counts the first so many episodes of each copy, and no others."""

    def __init__(self, episodes: int, copies: int) -> None:
        share, rest = divmod(episodes, copies)
        self.left = np.full(copies, share) + (np.arange(copies) < rest)
        self.episodes = episodes
        self.sum_of_returns = 0.0
        self.sum_of_lengths = 0.0
        self.truncated = 0
        self.outcomes: dict[str, int] = {}

    def add(self, ended: Episodes, truncated: npt.NDArray[np.bool_]) -> None:
        counts = self.left[ended.slots] > 0
        self.left[ended.slots[counts]] -= 1
        self.sum_of_returns += float(ended.returns[counts].sum())
        self.sum_of_lengths += float(ended.lengths[counts].sum())
        self.truncated += int(truncated[ended.slots[counts]].sum())
        for name, values in ended.outcomes.items():
            self.outcomes[name] = self.outcomes.get(name, 0) + int(values[counts].sum())

    def rate(self, outcome: str) -> Rate | None:
        count = self.outcomes.get(outcome)
        return None if count is None else Rate(count, self.episodes)


def _play(actor: Actor, stepper: Stepper, counter: _Counter, seed: int) -> int:
    """Step until every copy has run its episodes; returns the number of steps."""
    obs = stepper.reset(seed=seed)
    _check_fit(actor, stepper)
    steps = 0
    while counter.left.any():
        step = stepper.step(actor.act(obs))
        steps += 1
        obs = step.obs
        if step.ended is not None:
            counter.add(step.ended, step.truncated)
    return steps


def _check_fit(actor: Actor, stepper: Stepper) -> None:
    inputs, found = actor.weights[0].shape[0], stepper.obs[0].size
    if inputs != found:
        raise TaskError(
            f"the policy takes {inputs} observations, the task gives {found}",
            hint="evaluate with the options it was trained with, such as lidar_samples",
        )


def _resolve(
    run_or_policy: str | Path | Actor, task: str | None, options: dict[str, Any]
) -> tuple[Actor, str, dict[str, Any]]:
    """The actor, its task, and the options of the environment."""
    if isinstance(run_or_policy, str | Path) and Path(run_or_policy).suffix != ".npz":
        run = Run.open(Path(run_or_policy))
        given = {key: value for key, value in options.items() if value is not None}
        known = run.config.options | dict(run.config.recipe.evaluation_options)
        return load_actor(run.policy_file()), task or run.config.task, known | given
    if task is None:
        raise TaskError("a policy alone does not tell its task", hint="give the task as well")
    if isinstance(run_or_policy, Actor):
        return run_or_policy, task, options
    return load_actor(Path(run_or_policy)), task, options


def _rate_to_dict(rate: Rate | None) -> dict[str, float] | None:
    if rate is None:
        return None
    low, high = rate.interval
    return {
        "count": rate.count,
        "total": rate.total,
        "value": rate.value,
        "low": low,
        "high": high,
    }
