"""The episodes of an evaluation, here or by workers.

How many episodes a copy runs is fixed in advance: of those that end first, the short ones would be too
many. Copies that share a world, such as the robots of one hall, run one each and begin it together; for
more episodes all of them start again. A world that simply went on would be another one in its second hour: what
happens in it then, such as a jam that dissolves when the first episodes are cut off, would
count the more, the more episodes are requested.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from gazelle.envs.floor_plan import FloorPlan
from gazelle.errors import TaskError
from gazelle.training.actor import Actor
from gazelle.training.importing import TaskModule, load_all
from gazelle.training.records import Ledger, Trail
from gazelle.training.stepper import Stepper
from gazelle.training.tasks import control_period, env_attribute, make_task
from gazelle.training.workers.callers import TRIES, call_all, workers_at

_BRANCH = 1  # of seeds: that of evaluations


@dataclass(frozen=True, kw_only=True)
class EvaluationSetup:
    """Policy, task and options of an evaluation."""

    actor: Actor
    """The policy."""
    task: str
    """A task's id or name."""
    options: Mapping[str, Any] = field(default_factory=dict)
    """Of the environment."""
    imports: tuple[TaskModule, ...] = ()
    """Modules that register the task."""
    together: int = 1
    """Copies that share a world."""


@dataclass(frozen=True, slots=True)
class EvaluationPart:
    """A share of an evaluation's episodes."""

    number: int
    """From 0."""
    copies: int
    """Of the environment."""
    episodes: int
    """Number of episodes counted."""
    seed: int
    """Seed from which the seeds of its rounds are derived."""


@dataclass(frozen=True, slots=True)
class EpisodesPlayed:
    """Episodes played by one worker, with their wall and simulated time."""

    ledger: Ledger
    """Each of them."""
    wall_seconds: float
    """Without building the environment [s]."""
    sim_seconds: float | None
    """Of all copies together [s]; None when the task has no control period."""
    floor_plan: FloorPlan | None
    """Obstacles of the world; None if unknown."""


def play_episodes(setup: EvaluationSetup, copies: int, episodes: int, seed: int) -> EpisodesPlayed:
    """Run the policy until a given number of episodes ended, fixed in advance for each copy."""
    env = make_task(setup.task, copies, **setup.options)
    try:
        period = control_period(env)
        plan = env_attribute(env, "floor_plan")
        ledger = Ledger(setup.together, tuple(env_attribute(env, "scenario_names") or ()))
        stepper = Stepper(env, keep_info=True)
        start = time.perf_counter()
        steps = 0
        for number, each in enumerate(_rounds(copies, episodes, setup.together)):
            ledger.expect(each)
            steps += _play(setup.actor, stepper, ledger, evaluation_seed(seed, number))
        wall = time.perf_counter() - start
    finally:
        env.close()
    return EpisodesPlayed(ledger, wall, None if period is None else steps * copies * period, plan)


def _rounds(copies: int, episodes: int, together: int) -> Iterator[npt.NDArray[np.int64]]:
    """Yield the number of episodes each copy runs from one reset to the next, shapes (copies,)."""
    if together == 1:
        share, rest = divmod(episodes, copies)
        yield share + (np.arange(copies) < rest).astype(np.int64)
        return
    for done in range(0, episodes, copies):
        yield (np.arange(copies) < episodes - done).astype(np.int64)


def evaluation_seed(seed: int, number: int = 0) -> int:
    """Return the seed of one part of an evaluation.

    Trainings hand their seed to the environment as it is, and ``[seed, shard]`` to the shards of
    workers. Parts of an evaluation are on a branch of their own, so that with equal seeds no
    start, heading or phase of a training is drawn again.

    Args:
        seed: Seed of the evaluation.
        number: Part of it, from 0.

    Raises:
        TaskError: The seed is negative.
    """
    if seed < 0:
        raise TaskError(f"seed must not be negative: {seed}")
    branch = np.random.SeedSequence([seed, number], spawn_key=(_BRANCH,))
    return int(branch.generate_state(1)[0])


def play_with_workers(
    setup: EvaluationSetup,
    sizes: Sequence[int],
    episodes: int,
    seed: int,
    workers: int | None,
    ray: str | None,
) -> list[EpisodesPlayed]:
    """Run the policy in parts that workers play.

    Args:
        setup: Policy and environment.
        sizes: Copies of the environment in each part.
        episodes: Of all parts together.
        seed: Each part has one of its own that follows from it.
        workers: Number; None for one a processor.
        ray: The address of a Ray cluster; None for processes on this machine.

    Returns:
        The parts in order.

    Raises:
        TaskError: There is no such cluster, or workers are lost again and again.
    """
    parts = list(_parts(sizes, episodes, seed))
    found: dict[int, EpisodesPlayed] = {}

    def done(part: EvaluationPart, result: EpisodesPlayed | None) -> None:
        if result is None:
            raise TaskError(
                f"{TRIES} workers ended in the same episodes",
                hint="their output is above; is there enough memory?",
            )
        found[part.number] = result

    count, start = workers_at(ray, workers, EvaluationHost, setup)
    call_all(parts, start, done, workers=min(count, len(parts)))
    return [found[part.number] for part in parts]


def _parts(sizes: Sequence[int], episodes: int, seed: int) -> Iterator[EvaluationPart]:
    """Yield parts in which every copy runs as many episodes, except for the remainder."""
    share, rest = divmod(episodes, sum(sizes))
    first = 0
    for number, size in enumerate(sizes):
        more = min(max(rest - first, 0), size)
        if share * size + more:
            chance = evaluation_seed(seed, number)
            yield EvaluationPart(number, size, share * size + more, chance)
        first += size


class EvaluationHost:
    """A worker's side: plays episodes.

    Args:
        setup: Policy and environment.
    """

    def __init__(self, setup: EvaluationSetup) -> None:
        self._setup = setup

    def call(self, part: EvaluationPart) -> EpisodesPlayed:
        """Run the episodes of one part."""
        load_all(self._setup.imports)
        return play_episodes(self._setup, part.copies, part.episodes, part.seed)

    def close(self) -> None:
        """Do nothing: there is nothing to close."""


def _play(actor: Actor, stepper: Stepper, ledger: Ledger, seed: int) -> int:
    """Step until every copy has run its episodes; returns the number of steps."""
    obs = stepper.reset(seed=seed)
    _check_fit(actor, stepper)
    trail = Trail(stepper.num_envs)
    trail.follow(obs, ~stepper.waiting)
    steps = 0
    memory = actor.begin(stepper.num_envs)
    while ledger.left.any():
        step = stepper.step(actor.act(obs, memory=memory))
        steps += 1
        if memory is not None:
            memory.forget(step.begun)
        obs = step.obs
        if step.ended is not None and step.final_obs is not None:
            ledger.add(step.ended, trail.end(step.ended, step.final_obs))
        trail.follow(obs, ~stepper.waiting)
    return steps


def _check_fit(actor: Actor, stepper: Stepper) -> None:
    inputs, found = actor.inputs, stepper.obs[0].size
    if inputs != found:
        raise TaskError(
            f"the policy takes {inputs} observations, the task gives {found}",
            hint="evaluate with the options it was trained with, such as lidar_samples",
        )
