"""Positions of joints, and Jacobians."""
# ruff: noqa: N802 - the names are KDL's

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle_ros.compat.PyKDL.motion import Twist
from gazelle_ros.compat.PyKDL.vector import Vector


class JntArray:
    """One number a joint."""

    __hash__ = None  # type: ignore[assignment]  # it can change

    def __init__(self, size: int | JntArray = 0) -> None:
        given = size.data if isinstance(size, JntArray) else np.zeros(size)
        self.data: NDArray[np.float64] = np.array(given)

    def rows(self) -> int:
        """Return how many joints there are."""
        return len(self.data)

    def columns(self) -> int:
        """Return 1."""
        return 1

    def resize(self, size: int) -> None:
        """Set another size, and zero all."""
        self.data = np.zeros(size)

    def __len__(self) -> int:
        return len(self.data)

    def __getitem__(self, place: int) -> float:
        return float(self.data[place])

    def __setitem__(self, place: int, value: float) -> None:
        self.data[place] = value

    def __iter__(self) -> Iterator[float]:
        return iter(self.data.tolist())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, JntArray) and np.array_equal(self.data, other.data)

    def __repr__(self) -> str:
        return f"[{', '.join(f'{value:g}' for value in self.data)}]"


class Jacobian:
    """Six rows, linear before angular, and one column a joint."""

    __hash__ = None  # type: ignore[assignment]  # it can change

    def __init__(self, columns: int = 0) -> None:
        self.data = np.zeros((6, columns))

    def rows(self) -> int:
        """Return 6."""
        return 6

    def columns(self) -> int:
        """Return how many joints there are."""
        return int(self.data.shape[1])

    def getColumn(self, column: int) -> Twist:
        """Return the motion of the tip at one unit of a joint's speed."""
        values = self.data[:, column].tolist()
        return Twist(Vector(*values[:3]), Vector(*values[3:]))

    def __getitem__(self, place: Any) -> float:
        return float(self.data[place])

    def __setitem__(self, place: Any, value: float) -> None:
        self.data[place] = value

    def __repr__(self) -> str:
        return repr(self.data)
