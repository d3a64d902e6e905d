"""Relabelling of transitions with goals that were reached later (hindsight)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from gymnasium.vector import VectorEnv
from numpy.typing import NDArray

from gazelle.array_types import Floats32
from gazelle.envs.dict_rows import ACHIEVED, DESIRED, DictRows
from gazelle.errors import TaskError


@dataclass(frozen=True, slots=True)
class GoalReplay:
    """Layout of goals in the rows of a replay memory, and their reward.

    Attributes:
        achieved: Place of the achieved goal in a row.
        desired: Place of the desired goal in a row.
        shape: Of one goal.
        reward: ``compute_reward`` of the environment.
    """

    achieved: slice
    desired: slice
    shape: tuple[int, ...]
    reward: Callable[[NDArray[Any], NDArray[Any], Any], Any]

    def rewards(self, achieved: Floats32, desired: Floats32) -> Floats32:
        """Return rewards of steps with this achieved and that desired goal.

        Args:
            achieved: Shape (n, entries).
            desired: Shape (n, entries).

        Raises:
            TaskError: ``compute_reward`` does not give one number each.
        """
        count = len(achieved)
        # An info for each, as Stable-Baselines3 hands them over.
        infos: list[dict[str, Any]] = [{}] * count
        goals = achieved.reshape(count, *self.shape), desired.reshape(count, *self.shape)
        found = np.asarray(self.reward(*goals, infos), np.float32)
        if found.shape != (count,):
            raise TaskError(
                f"compute_reward returned an array of shape {found.shape} for {count} goals",
                hint="it must take many goals at once, as in norm(achieved - desired, axis=-1)",
            )
        return found


def goal_replay(env: VectorEnv[Any, Any, Any], rows: DictRows | None) -> GoalReplay | None:
    """Return the relabelling of an environment's steps with other goals; None if it has no goals.

    Args:
        env: Has ``compute_reward``, or its copies have.
        rows: Layout of the parts of its observations in a row.
    """
    if rows is None or not rows.has_goals:
        return None
    for each in (env.unwrapped, *getattr(env.unwrapped, "envs", ())[:1]):
        reward = getattr(each.unwrapped, "compute_reward", None)
        if reward is not None:
            shape = rows.space.spaces[DESIRED].shape or ()
            return GoalReplay(rows.slices[ACHIEVED], rows.slices[DESIRED], shape, reward)
    return None
