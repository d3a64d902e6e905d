"""Observations in a Dict as the rows of one array, and back."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats32
from gazelle.errors import TaskError

OBSERVATION, ACHIEVED, DESIRED = "observation", "achieved_goal", "desired_goal"
"""The parts of a goal environment's observation, as Gymnasium-Robotics' ``GoalEnv`` names them."""


class DictRows:
    """Layout of a Dict of boxes as a row, in the order of the Dict.

    The order is the one of `gymnasium.spaces.flatten`.

    Args:
        space: Of one observation.

    Raises:
        TaskError: A part is no Box, or there is none.

    Attributes:
        space: Of one observation.
        row_space: Of one row, a Box of float32.
        slices: Slice of each part, by its key.
    """

    def __init__(self, space: gym.spaces.Dict) -> None:
        self.space = space
        self.slices: dict[str, slice] = {}
        bounds: list[tuple[NDArray[Any], NDArray[Any]]] = []
        place = 0
        for key, part in space.spaces.items():
            if not isinstance(part, gym.spaces.Box):
                raise TaskError(
                    f"the part '{key}' of the observation is a {type(part).__name__}",
                    hint="only a Dict of boxes can be flattened",
                )
            size = int(np.prod(part.shape))
            self.slices[key] = slice(place, place + size)
            bounds.append((part.low.reshape(-1), part.high.reshape(-1)))
            place += size
        if not place:
            raise TaskError("an observation without numbers cannot be learnt from")
        low, high = (np.concatenate(each).astype(np.float32) for each in zip(*bounds, strict=True))
        self.row_space = gym.spaces.Box(low, high, dtype=np.float32)

    @property
    def size(self) -> int:
        """Entries of a row."""
        return int(self.row_space.shape[0])

    @property
    def has_goals(self) -> bool:
        """True if it is the observation of a goal environment."""
        return {OBSERVATION, ACHIEVED, DESIRED} <= set(self.slices)

    def join(self, parts: Mapping[str, Any]) -> Floats32:
        """Return rows of shape (n, size) from parts of shape (n, ...).

        Raises:
            TaskError: A part is missing, or the shapes do not fit.
        """
        try:
            count = len(parts[next(iter(self.slices))])
            rows = np.empty((count, self.size), np.float32)
            for key, place in self.slices.items():
                rows[:, place] = np.reshape(parts[key], (count, -1))
        except KeyError as error:
            raise TaskError(f"there is no part {error}") from error
        except (TypeError, ValueError) as error:
            raise TaskError(f"the parts do not fit {self.space}: {error}") from error
        return rows

    def split(self, rows: Floats32) -> dict[str, Floats32]:
        """Return parts of shape (n, ...), as own arrays, from rows of shape (n, size).

        Raises:
            TaskError: The rows have another shape.
        """
        if rows.shape[1:] != (self.size,):
            raise TaskError(f"rows have the shape (n, {self.size}), not {rows.shape}")
        return {
            key: rows[:, place].reshape(len(rows), *(self.space.spaces[key].shape or ())).copy()
            for key, place in self.slices.items()
        }
