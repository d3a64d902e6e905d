"""What native control steps of a TurtleBot3 task write, and what a caller gets of it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats
from gazelle.envs.batched_task import Finals, Info, Step, Transition
from gazelle.envs.turtlebot3 import kernels_step as k


class Outcome:
    """Arrays that are written again by every step; callers get copies.

    Args:
        nworld: Number of worlds.
        size: Of an observation.

    Attributes:
        observation: Shape (nworld, size); of the next episode where one ended.
        last_observation: The last ones of episodes that ended, shape (nworld, size).
        reward: Shape (nworld,).
        nearest: Shortest ranges [m], shape (nworld,).
        crashed: Who is too near to something, shape (nworld,).
        arrived: Who is at the goal, shape (nworld,).
        ends: See ``kernels_step``, as the next ones.
        how: What ended episodes: success, collision, time-out.
        numbers: Distances to the goal [m] and headings of it [rad].
        counts: Goals reached in the episode.
        points: Goals and places of robots (x, y) [m].
    """

    def __init__(self, nworld: int, size: int) -> None:
        self.observation, self.last_observation = np.zeros((2, nworld, size), np.float32)
        self.reward, self.nearest = np.zeros((2, nworld))
        self.crashed, self.arrived = np.zeros((2, nworld), np.bool_)
        self.ends = np.zeros((k.ENDS, nworld), np.bool_)
        self.how = np.zeros((2, k.HOW, nworld), np.bool_)
        self.numbers = np.zeros((2, k.NUMBERS, nworld))
        self.counts = np.zeros((2, nworld), np.int64)
        self.points = np.zeros((2, nworld, k.POINTS))

    def step(self, *, timed: bool) -> Step:
        """What the last step brought; ``timed``: episodes have a step limit."""
        ends = self.ends.copy()
        rows = (self.how.copy(), self.numbers.copy(), self.points.copy(), self.counts.copy())
        now, last = (_info(*row, timed=timed) for row in zip(*rows, strict=True))
        transition = Transition(
            self.observation.copy(),
            self.reward.copy(),
            ends[k.TERMINATED],
            ends[k.TRUNCATED],
            now,
        )
        worlds = np.flatnonzero(ends[k.DONE])
        if not len(worlds):
            return Step(transition, None)
        return Step(transition, Finals(worlds, self.last_observation[worlds], last))


def _info(
    how: Bools, numbers: Floats, points: Floats, reached: NDArray[np.int64], *, timed: bool
) -> Info:
    """As ``TurtleBot3Task`` spells it."""
    info: Info = {
        "is_success": how[k.SUCCESS],
        "is_collision": how[k.COLLISION],
        "distance": numbers[k.DISTANCE],
        "heading": numbers[k.HEADING],
        "goal": points[:, :2],
        "position": points[:, 2:],
        "goals_reached": reached,
    }
    return {**info, "is_timeout": how[k.TIMEOUT]} if timed else info
