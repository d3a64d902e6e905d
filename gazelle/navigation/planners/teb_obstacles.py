"""Obstacles of timed elastic bands: a grid's distances, and shapes that may move."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from gazelle.array_types import Floats

NOWHERE = 1e3
"""Distance where there is no obstacle [m]."""
_MOVING = 1e-3  # Least speed of a moving obstacle [m/s], the original's


@dataclass(frozen=True, slots=True)
class BandObstacle:
    """A point, circle, line or polygon with a constant velocity.

    Attributes:
        corners: In order, shape (n, 2) [m].
        radius: Around them [m].
        velocity: Along x and y [m/s].
    """

    corners: Floats
    radius: float = 0.0
    velocity: Floats = field(default_factory=lambda: np.zeros(2))

    @property
    def moving(self) -> bool:
        """True above 1 mm/s."""
        return float(np.hypot(*self.velocity)) >= _MOVING

    @property
    def middle(self) -> Floats:
        """Mean of the corners."""
        found: Floats = self.corners.mean(axis=0)
        return found

    def distances(self, points: Floats, times: Floats) -> Floats:
        """Return the distances of points at times, negative inside.

        Args:
            points: Shape (n, k, 2) [m].
            times: From now, shape (n,) [s].

        Returns:
            Shape (n, k) [m].
        """
        points = points - times[:, None, None] * self.velocity
        first = self.corners
        along = np.roll(first, -1, axis=0) - first
        away = points[..., None, :] - first
        squares = np.maximum((along * along).sum(axis=1), 1e-12)
        share = np.clip((away * along).sum(axis=-1) / squares, 0.0, 1.0)
        least = np.hypot(*np.moveaxis(away - share[..., None] * along, -1, 0)).min(axis=-1)
        if len(first) > 2:
            # A ray along x crosses the border an odd number of times.
            over = (away[..., 1] < 0.0) != (np.roll(away, -1, axis=-2)[..., 1] < 0.0)
            side = along[:, 0] * away[..., 1] - along[:, 1] * away[..., 0]
            inside = (over & ((side < 0.0) == (along[:, 1] > 0.0))).sum(axis=-1) % 2 == 1
            least = np.where(inside, -least, least)
        found: Floats = least - self.radius
        return found


@dataclass(frozen=True, slots=True)
class ObstacleDistances:
    """Distances to obstacles on a grid, and to shapes that stand.

    Attributes:
        values: From the middles of cells [m], shape (rows, columns); None without any obstacle.
        origin: Corner of the grid [m].
        resolution: Side of a cell [m].
        shapes: Other obstacles.
    """

    values: Floats | None
    origin: tuple[float, float]
    resolution: float
    shapes: Sequence[BandObstacle] = ()

    def at(self, points: Floats) -> Floats:
        """Return the distances at points, shape (n, k, 2), between cells bilinearly."""
        found = self._on_grid(points)
        if self.shapes:
            found = np.minimum(found, nearest(self.shapes, points, np.zeros(len(points))))
        return found

    def _on_grid(self, points: Floats) -> Floats:
        if self.values is None:
            return np.full(points.shape[:-1], NOWHERE)
        rows, columns = self.values.shape
        place = (points - np.array(self.origin)) / self.resolution - 0.5
        x = np.clip(place[..., 0], 0.0, columns - 1.001)
        y = np.clip(place[..., 1], 0.0, rows - 1.001)
        column, row = x.astype(np.intp), y.astype(np.intp)
        s, t = x - column, y - row
        v = self.values
        low = (1.0 - s) * v[row, column] + s * v[row, column + 1]
        high = (1.0 - s) * v[row + 1, column] + s * v[row + 1, column + 1]
        found: Floats = (1.0 - t) * low + t * high
        return found


def nearest(obstacles: Sequence[BandObstacle], points: Floats, times: Floats) -> Floats:
    """Return the least distance of points, shape (n, k, 2), to any obstacle, shape (n, k) [m]."""
    found: Floats = np.min([each.distances(points, times) for each in obstacles], axis=0)
    return found
