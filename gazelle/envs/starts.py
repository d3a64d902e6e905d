"""Starts of episodes that differ: where the robot is, how it looks, and how far scripts are."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.errors import TaskError
from gazelle.plugins.scripted_motion import ScriptedMotion
from gazelle.simulation import Robot
from gazelle.streams import Stream

APART = 0.5
"""A robot starts farther than this from its goal [m]."""
CLEAR = 0.35
"""And with nothing nearer than this to its lidar, where there is such a place [m]."""

_TRIES = 8


class RandomStarts:
    """Draws where episodes begin, one world knowing nothing of the others.

    Args:
        places: Possible starts of the robot (x, y) [m], shape (n, 2).
        nworld: Number of worlds.

    Attributes:
        poses: x, y [m] and heading [rad] of the robot at its start, shape (nworld, 3).
        phases: Time since scripts began [s], shape (nworld, scripts).

    Raises:
        TaskError: There is no place.
    """

    def __init__(self, places: Floats, nworld: int) -> None:
        if not len(places):
            raise TaskError(
                "there is no free place to start from",
                hint='leave the robot where it starts, with starts="published"',
            )
        self._places = places
        self.poses = np.zeros((nworld, 3))
        self.phases = np.zeros((nworld, 0))

    def seed(self, seed: int, robot: Robot) -> None:
        """Start over with a seed, in the simulation that this robot is in."""
        entries = robot.simulation.plugins
        self._robot = robot
        self._scripts = [
            entry.plugin for entry in entries if isinstance(entry.plugin, ScriptedMotion)
        ]
        nworld = len(self.poses)
        self._stream = Stream(seed, "starts", nworld)
        self.poses = np.zeros((nworld, 3))
        self.phases = np.zeros((nworld, len(self._scripts)))

    def begin(self, worlds: Worlds, goals: Floats, nearest: Callable[[Worlds], Floats]) -> None:
        """Place robot and scripts at random, in worlds that were just reset.

        Args:
            worlds: Worlds, shape (n,).
            goals: Goals of the robots (x, y) [m], shape (n, 2).
            nearest: The shortest range that a lidar has in some worlds now [m].
        """
        scripts = len(self._scripts)
        drawn = self._stream.uniform(1 + scripts + _TRIES, worlds)
        for script, share in zip(self._scripts, range(1, 1 + scripts), strict=True):
            elapsed = drawn[:, share] * script.period
            self.phases[worlds, share - 1] = elapsed
            script.begin_at(elapsed, worlds)
        yaw = (2.0 * drawn[:, 0] - 1.0) * np.pi
        numbers = (drawn[:, 1 + scripts :] * len(self._places)).astype(np.intp)
        choices = self._places.take(numbers, axis=0)
        away = choices - goals[:, None, :]
        near_goal = np.hypot(away[:, :, 0], away[:, :, 1]) <= APART
        position = self._robot.placement(worlds).position
        pending = np.arange(len(worlds))
        for attempt in range(_TRIES):
            position[pending, :2] = choices[pending, attempt]
            some = worlds[pending]
            self._robot.set_pose(position[pending], yaw=yaw[pending], worlds=some)
            pending = pending[near_goal[pending, attempt] | (nearest(some) < CLEAR)]
            if not len(pending):
                break
        position[:, 2] = yaw
        self.poses[worlds] = position

    def get_state(self) -> dict[str, Any]:
        """Return the state for a saved environment."""
        return {
            "start_draws": self._stream.counters.copy(),
            "start_poses": self.poses.copy(),
            "start_phases": self.phases.copy(),
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Restore what ``get_state`` returned, after ``seed``."""
        self._stream.counters[:] = state["start_draws"]
        self.poses[:], self.phases[:] = state["start_poses"], state["start_phases"]


def held_out_starts(trained: Mapping[str, Any]) -> dict[str, Any]:
    """Return ``evaluation_options`` of tasks with ``starts``: starts not used in training."""
    del trained
    return {"starts": "held-out"}


def chessboard(columns: int, rows: int, *, held_out: bool) -> Floats:
    """Return column and row of the squares of one colour, shape (n, 2).

    Args:
        columns: Of the board.
        rows: Likewise.
        held_out: Those of the other colour, which trainings do not see.
    """
    column, row = np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij")
    colour = (column + row) % 2 == int(held_out)
    return np.asarray(np.stack((column, row), axis=-1)[colour], np.float64)
