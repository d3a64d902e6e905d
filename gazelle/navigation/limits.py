"""Limits of a mobile robot: speeds, clearances, and the size of its map."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.argument_checks import checked
from gazelle.errors import Error, SimulationError

MAX_PARTICLES = 10_000_000
"""Of a filter."""

MAX_CELLS = 1 << 37
"""Of the maps of all particles together, used or not; 4 bytes for 1,024 that are not."""


@checked(SimulationError)
@dataclass(frozen=True, slots=True)
class BaseLimits:
    """Limits of a base and its clearance.

    Attributes:
        radius: Of the smallest circle around its turning axis that holds it [m].
        clearance: Least distance to obstacles beyond that [m].
        linear: Highest speed ahead [m/s].
        angular: Highest turning rate [rad/s].
        linear_acceleration: [m/s²].
        angular_acceleration: [rad/s²].

    Raises:
        SimulationError: One of them is not positive.
    """

    radius: float = 0.2
    clearance: float = 0.05
    linear: float = 0.6
    angular: float = 1.5
    linear_acceleration: float = 0.8
    angular_acceleration: float = 4.0

    def __post_init__(self) -> None:
        for name in self.__slots__:
            value = getattr(self, name)
            if not value > 0.0:
                raise SimulationError(f"the limit '{name}' must be positive, not {value:g}")


def check_maps(count: int, columns: float, rows: float) -> None:
    """Check that maps fit into memory.

    Raises:
        Error: They have too many cells, or none.
    """
    if not 0.0 < columns * rows * min(count, MAX_CELLS) <= MAX_CELLS:
        raise Error(f"{count} maps of {columns:g} x {rows:g} cells have none or over {MAX_CELLS:,}")
