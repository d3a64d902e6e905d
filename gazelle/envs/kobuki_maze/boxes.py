"""Boxes that go to and fro."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Bools, Floats, Worlds
from gazelle.envs.kobuki_maze.rules import BOX_STEP, KobukiRules
from gazelle.simulation import Robot


class MovingBoxes:
    """Boxes in many worlds, each along its own heading at its own pace.

    Args:
        rules: Of the task.
        boxes: The boxes.
        nworld: Number of worlds.

    Attributes:
        memory: All that changes, by name, each with a leading axis over worlds.
    """

    def __init__(self, rules: KobukiRules, boxes: Sequence[Robot], nworld: int) -> None:
        self._boxes = boxes
        self._home = np.array(rules.boxes).reshape(-1, 2)
        self._turns = rules.box_steps
        shape = (nworld, len(boxes))
        self._way = np.zeros(shape)
        self._heading = np.zeros(shape)
        self._pace = np.zeros(shape)
        self._direction = np.ones(nworld)
        self._steps = np.zeros(nworld, np.int64)
        self._first: Bools = np.ones(nworld, np.bool_)
        self.memory = {
            "box_way": self._way,
            "box_heading": self._heading,
            "box_pace": self._pace,
            "box_direction": self._direction,
            "box_steps": self._steps,
            "box_first": self._first,
        }

    def begin(self, worlds: Worlds, shares: Floats) -> None:
        """Place the boxes at their starts; ``shares`` in [0, 1) are of shape (n, 2 * boxes)."""
        count = len(self._boxes)
        self._heading[worlds] = (2.0 * shares[:, :count] - 1.0) * np.pi
        self._pace[worlds] = BOX_STEP * shares[:, count:]
        self._way[worlds] = 0.0
        self._direction[worlds], self._steps[worlds], self._first[worlds] = 1.0, 0, True
        self._put(worlds)

    def step(self) -> None:
        """Advance by one step; all boxes of a world turn back together."""
        self._steps += 1
        turned = self._steps > np.where(self._first, *self._turns)
        self._direction[turned] *= -1.0
        self._steps[turned], self._first[turned] = 0, False
        self._way += self._direction[:, None] * self._pace
        self._put(np.arange(len(self._way)))

    def _put(self, worlds: Worlds) -> None:
        heading, way = self._heading[worlds], self._way[worlds]
        for number, box in enumerate(self._boxes):
            angle, gone = heading[:, number], way[:, number]
            place = np.zeros((len(worlds), 3))
            place[:, 0] = self._home[number, 0] + gone * np.cos(angle)
            place[:, 1] = self._home[number, 1] + gone * np.sin(angle)
            box.set_pose(place, yaw=angle, worlds=worlds)
