"""A task that also shows where a base has been heading: a memory for those that do not show its yaw."""

from __future__ import annotations

from collections.abc import Sequence

import gymnasium as gym
import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats32, Worlds
from gazelle.envs.batched_task import BatchedTask
from gazelle.envs.limits import MAX_COURSE_STEPS
from gazelle.envs.options import check_integer
from gazelle.envs.wrappers import TaskWrapper
from gazelle.errors import TaskError


class CourseTask(TaskWrapper):
    """Shows behind each observation the course over the last steps, and what was done in them.

    For each number of steps: the direction of the way from where the base was seen a given number of steps ago to where
    it is seen now, an angle [rad] (0 while it is at the same place); and then for each number of steps and each
    action, the share of these steps in which it was taken. Nothing but what was observed and
    done goes into it. It starts again with every episode.

    Args:
        task: Task to wrap; with a few actions to choose from.
        x: Entry of its observations with the base's x [m].
        y: Entry with its y [m].
        steps: Over how many steps, such as ``(1, 4, 16)``.

    Raises:
        TaskError: The task has other actions, or there is no such entry.
    """

    def __init__(self, task: BatchedTask, x: int, y: int, steps: Sequence[int]) -> None:
        super().__init__(task)
        space, actions = task.observation_space, task.action_space
        if not isinstance(actions, gym.spaces.Discrete) or len(space.shape) != 1:
            raise TaskError("a course is for tasks with a few actions and vectors as observations")
        for entry in (x, y):
            if not 0 <= entry < space.shape[0]:
                raise TaskError(f"there is no entry {entry} to take a course from")
        for count in steps:
            check_integer("a number of steps of a course", count, 1, MAX_COURSE_STEPS)
        self._place, self._steps = [x, y], tuple(steps)
        self._start = int(actions.start)
        shares = len(self._steps) * int(actions.n)
        low = [*space.low.tolist(), *[-np.pi] * len(self._steps), *[0.0] * shares]
        high = [*space.high.tolist(), *[np.pi] * len(self._steps), *[1.0] * shares]
        self.observation_space = gym.spaces.Box(
            np.array(low, np.float32), np.array(high, np.float32), dtype=np.float32
        )
        kept = max(self._steps, default=0) + 1
        self.memory["places"] = np.zeros((task.nworld, kept, 2))
        self.memory["done"] = np.zeros((task.nworld, kept, int(actions.n)))

    def changed_actions(self, actions: ArrayLike) -> ArrayLike:
        """Store the actions; they stay as they are."""
        done = self.memory["done"]
        done[:, :-1] = done[:, 1:]
        done[:, -1] = np.eye(done.shape[2])[np.asarray(actions) - self._start]
        return actions

    def changed_observation(self, observation: Floats32) -> Floats32:
        """Return observations with courses and shares appended, shape (nworld, size)."""
        places = self.memory["places"]
        places[:, :-1] = places[:, 1:]
        places[:, -1] = observation[:, self._place]
        return self._with_course(observation, np.arange(self.nworld))

    def first_observation(self, observation: Floats32, worlds: Worlds) -> Floats32:
        """Return observations with courses and shares of 0 appended, shape (n, size)."""
        self.memory["places"][worlds] = observation[:, None, self._place]
        self.memory["done"][worlds] = 0.0
        return self._with_course(observation, worlds)

    def _with_course(self, observation: Floats32, worlds: Worlds) -> Floats32:
        places, done = self.memory["places"][worlds], self.memory["done"][worlds]
        parts = [observation]
        for count in self._steps:
            way = places[:, -1] - places[:, -1 - count]
            parts.append(np.arctan2(way[:, 1], way[:, 0])[:, None].astype(np.float32))
        parts += [done[:, -count:].mean(axis=1).astype(np.float32) for count in self._steps]
        return np.concatenate(parts, axis=1, dtype=np.float32)
