"""Rollout of a policy over some control steps of many copies of a task."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from gazelle.array_types import Bools, Floats32
from gazelle.training.actor import Actor
from gazelle.training.copies import TaskCopies
from gazelle.training.episodes import Episodes


@dataclass(frozen=True, slots=True)
class CutOff:
    """Episodes that were cut off in a rollout, k of them, by step and copy.

    Attributes:
        rows: In which steps, shape (k,).
        slots: In which copies, shape (k,).
        final_obs: Their last observations, shape (k, ...).
    """

    rows: npt.NDArray[np.intp]
    slots: npt.NDArray[np.intp]
    final_obs: Floats32


@dataclass(frozen=True, slots=True)
class Rollout:
    """Steps of all copies; arrays have shape (steps, copies, ...) unless said.

    Attributes:
        observations: Observations of the actions.
        outputs: The last layer's outputs for them.
        actions: Raw, as `Actor.sample` draws them, shape (steps, copies, entries).
        rewards: Scaled rewards of the learner.
        starts: Whether an episode began with the observation.
        valid: False where the step was spent on a reset.
        cut_off: The episodes that were cut off.
        ended: Those that ended, with the step.
        last_obs: Next observations, shape (copies, ...).
        last_starts: Whether an episode begins with it, shape (copies,).
    """

    observations: Floats32
    outputs: Floats32
    actions: npt.NDArray[Any]
    rewards: Floats32
    starts: Bools
    valid: Bools
    cut_off: CutOff
    ended: tuple[tuple[int, Episodes], ...]
    last_obs: Floats32
    last_starts: Bools


def play(
    env: TaskCopies,
    actor: Actor,
    steps: int,
    *,
    rng: np.random.Generator,
    on_step: Callable[[], bool] | None = None,
) -> Rollout | None:
    """Run a policy for a given number of control steps, from the environment's present state.

    Args:
        env: The copies of the task.
        actor: The policy.
        steps: Number of steps.
        rng: Random generator of the actions.
        on_step: Called after each step; what it returns says whether to continue.

    Returns:
        What was met; None if it did not continue.
    """
    copies = env.num_envs
    observations = np.empty((steps, *env.obs.shape), env.obs.dtype)
    outputs = np.empty((steps, copies, len(actor.biases[-1])), np.float32)
    rewards = np.empty((steps, copies), np.float32)
    starts, valid = (np.empty((steps, copies), np.bool_) for _ in range(2))
    drawn: list[npt.NDArray[Any]] = []
    cut_off: list[tuple[int, npt.NDArray[np.intp], Floats32]] = []
    ended: list[tuple[int, Episodes]] = []
    for row in range(steps):
        observations[row], starts[row] = env.obs, env.starts
        outputs[row] = actor.outputs(env.obs.reshape(copies, -1))
        actions = actor.sample(outputs[row], rng)
        drawn.append(actions.reshape(copies, -1))
        step = env.advance(actor.to_env(actions))
        rewards[row] = env.scaled(step)
        valid[row] = step.valid
        if step.ended is not None and step.final_obs is not None:
            ended.append((row, step.ended))
            which = step.truncated[step.ended.slots]
            if which.any():
                cut_off.append((row, step.ended.slots[which], step.final_obs[which]))
        if on_step is not None and not on_step():
            return None
    return Rollout(
        observations,
        outputs,
        np.stack(drawn),
        rewards,
        starts,
        valid,
        _cut_off(cut_off, env.obs),
        tuple(ended),
        env.obs,
        env.starts,
    )


def join(rollouts: Sequence[Rollout]) -> Rollout:
    """Join rollouts of as many steps side by side; copies keep the order."""
    sizes = [len(each.last_obs) for each in rollouts]
    before = np.concatenate([[0], np.cumsum(sizes)[:-1]])

    def beside(name: str) -> Any:
        return np.concatenate([getattr(each, name) for each in rollouts], axis=1)

    def after(name: str) -> Any:
        return np.concatenate([getattr(each, name) for each in rollouts])

    parts = [each.cut_off for each in rollouts]
    ended = [
        (row, episodes.moved(int(shift)))
        for each, shift in zip(rollouts, before, strict=True)
        for row, episodes in each.ended
    ]
    return Rollout(
        beside("observations"),
        beside("outputs"),
        beside("actions"),
        beside("rewards"),
        beside("starts"),
        beside("valid"),
        CutOff(
            np.concatenate([each.rows for each in parts]),
            np.concatenate([each.slots + shift for each, shift in zip(parts, before, strict=True)]),
            np.concatenate([each.final_obs for each in parts]),
        ),
        tuple(sorted(ended, key=lambda pair: pair[0])),
        after("last_obs"),
        after("last_starts"),
    )


def _cut_off(found: list[tuple[int, npt.NDArray[np.intp], Floats32]], like: Floats32) -> CutOff:
    if not found:
        none = np.zeros(0, np.intp)
        return CutOff(none, none, np.zeros((0, *like.shape[1:]), like.dtype))
    return CutOff(
        np.concatenate([np.full(len(slots), row, np.intp) for row, slots, _ in found]),
        np.concatenate([slots for _, slots, _ in found]),
        np.concatenate([last for _, _, last in found]),
    )
