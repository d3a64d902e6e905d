"""Goal positions of the TurtleBot3 DQN tasks (``turtlebot3_machine_learning``, ROS 1)."""

from __future__ import annotations

import numpy as np

from gazelle.envs.goals import GoalTable

_BLOCKED = ((0.6, 0.6), (0.6, -0.6), (-0.6, 0.6), (-0.6, -0.6), (0.0, 0.0))
_CLEARANCE = 0.4
_APART = 1.0
_PLAZA = (
    (0.6, 0.0),
    (1.9, -0.5),
    (0.5, -1.9),
    (0.2, 1.5),
    (-0.8, -0.9),
    (-1.0, 1.0),
    (-1.9, 1.1),
    (0.5, -1.5),
    (2.0, 1.5),
    (0.5, 1.8),
    (0.0, -1.0),
    (-0.1, 1.6),
    (-2.0, -0.8),
)


def grid_goals() -> GoalTable:
    """Return goals of stages 1 to 3: a grid of 0.1 m in a square of 2.4 m, clear of obstacles.

    The first goal is (0.6, 0); the next is 1 m or more from the last one along x or y.
    """
    ticks = np.arange(-12, 13) / 10.0
    grid = np.stack(np.meshgrid(ticks, ticks, indexing="ij"), axis=-1).reshape(-1, 2)
    offsets = np.abs(grid[:, None, :] - np.array(_BLOCKED)[None, :, :])
    blocked = (offsets <= _CLEARANCE).all(axis=2).any(axis=1)
    points = grid[~blocked]
    first = int(np.abs(points - _PLAZA[0]).max(axis=1).argmin())
    near = (np.abs(points[:, None, :] - points[None, :, :]) < _APART).all(axis=2)
    return GoalTable(points, ~near, start=first)


def plaza_goals() -> GoalTable:
    """Return goals of stage 4: thirteen places, never one twice in a row.

    The first is (0.6, 0).
    """
    return GoalTable(_PLAZA)
