"""What native control steps of a TurtleBot3 task write, and what a caller gets of it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.envs.batched_task import Bool, Finals, Float64, Info, Step, Transition
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
        flags: See ``kernels_step``, as the next ones.
        numbers: Distances to the goal [m] and headings of it [rad].
        counts: Goals reached in the episode.
        points: Goals [m].
    """

    def __init__(self, nworld: int, size: int) -> None:
        self.observation, self.last_observation = np.zeros((2, nworld, size), np.float32)
        self.reward, self.nearest = np.zeros((2, nworld))
        self.crashed, self.arrived = np.zeros((2, nworld), np.bool_)
        self.flags = np.zeros((k.FLAGS, nworld), np.bool_)
        self.numbers = np.zeros((k.NUMBERS, nworld))
        self.counts = np.zeros((k.COUNTS, nworld), np.int64)
        self.points = np.zeros((k.PLACES, nworld, 2))

    def step(self, *, timed: bool) -> Step:
        """What the last step brought; ``timed``: episodes have a step limit."""
        flags, numbers = self.flags.copy(), self.numbers.copy()
        counts, points = self.counts.copy(), self.points.copy()
        now = _info(
            flags[k.SUCCESS : k.TIMEOUT + 1],
            numbers[k.DISTANCE : k.HEADING + 1],
            points[k.GOAL],
            counts[k.REACHED],
            timed=timed,
        )
        transition = Transition(
            self.observation.copy(),
            self.reward.copy(),
            flags[k.TERMINATED],
            flags[k.TRUNCATED],
            now,
        )
        worlds = np.flatnonzero(flags[k.DONE])
        if not len(worlds):
            return Step(transition, None)
        last = _info(
            flags[k.LAST_SUCCESS : k.LAST_TIMEOUT + 1],
            numbers[k.LAST_DISTANCE : k.LAST_HEADING + 1],
            points[k.LAST_GOAL],
            counts[k.LAST_REACHED],
            timed=timed,
        )
        return Step(transition, Finals(worlds, self.last_observation[worlds], last))


def _info(
    flags: Bool, numbers: Float64, goal: Float64, reached: NDArray[np.int64], *, timed: bool
) -> Info:
    """As ``TurtleBot3Task`` spells it; rows are in the order of ``kernels_step``."""
    info: Info = {
        "is_success": flags[0],
        "is_collision": flags[1],
        "distance": numbers[0],
        "heading": numbers[1],
        "goal": goal,
        "goals_reached": reached,
    }
    return {**info, "is_timeout": flags[2]} if timed else info
