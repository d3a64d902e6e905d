"""The layer that keeps robots away from obstacles."""

from __future__ import annotations

import math

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Bytes
from gazelle.errors import Error
from gazelle.navigation.costmap.costmap import Costmap, Layer
from gazelle.navigation.costmap.distances import squared_distances
from gazelle.navigation.costmap.values import (
    FREE_SPACE,
    INSCRIBED,
    LETHAL,
    NO_INFORMATION,
    CostmapBounds,
    Window,
)
from gazelle.navigation.following import Pose2


@checked(Error, after=True)
class InflationLayer(Layer):
    """Costs that fall off around obstacles: 252 exp(-k (d - inscribed radius)).

    Args:
        name: Within the costmap.
        radius: Radius of the inflation [m].
        scaling: Decay of costs, k above [1/m].
        inflate_unknown: Whether unknown cells get costs as far as they are above free; else only
            those within the inscribed radius.
    """

    def __init__(
        self,
        name: str = "inflation_layer",
        *,
        radius: float = 0.55,
        scaling: float = 10.0,
        inflate_unknown: bool = False,
    ) -> None:
        super().__init__(name)
        self.radius, self.scaling = radius, scaling
        self._inflate_unknown = inflate_unknown
        self._table: Bytes = np.zeros(1, np.uint8)
        self._reach = 0
        self._all = True

    def resized(self, costmap: Costmap) -> None:
        """Compute the costs of distances again."""
        self._prepare(costmap)

    def footprint_changed(self, costmap: Costmap) -> None:
        """Compute the costs of distances again."""
        self._prepare(costmap)

    def cost_of(self, distance: float, costmap: Costmap) -> int:
        """Return the cost at a distance from an obstacle [m]."""
        if distance <= 0.0:
            return LETHAL
        if distance <= costmap.inscribed:
            return INSCRIBED
        return int((INSCRIBED - 1) * math.exp(-self.scaling * (distance - costmap.inscribed)))

    def _prepare(self, costmap: Costmap) -> None:
        """Compute a table of costs by squared distance in cells."""
        side = costmap.resolution
        reach = min(self.radius / side, float(max(costmap.cells.shape)))
        self._reach = max(math.ceil(reach - 1e-9), 0)
        squares = np.arange(self._reach**2 + 2)
        self._table = np.array(
            [self.cost_of(math.sqrt(square) * side, costmap) for square in squares], np.uint8
        )
        self._table[-1] = FREE_SPACE
        self._all = True

    def reset(self) -> None:
        """Mark everything as changed; there are no observations to clear."""
        self._all = True

    def update_bounds(self, costmap: Costmap, pose: Pose2, region: CostmapBounds) -> None:
        """Grow the changed region by the inflation radius."""
        del pose
        if self._all:
            rows, columns = costmap.cells.shape
            region.touch(*costmap.place_of(0, 0))
            region.touch(*costmap.place_of(columns - 1, rows - 1))
            self._all = False
        region.grow(self.radius)

    def update_costs(self, costmap: Costmap, window: Window) -> None:
        """Raise the costs around obstacles, as far as those are within reach of the window."""
        if self._reach == 0:
            return
        rows, columns = costmap.cells.shape
        x0, y0 = max(window.x0 - self._reach, 0), max(window.y0 - self._reach, 0)
        x1, y1 = min(window.x1 + self._reach, columns), min(window.y1 + self._reach, rows)
        around = costmap.cells[y0:y1, x0:x1] == LETHAL
        if not around.any():
            return
        squares = squared_distances(around.view(np.uint8))
        inner = squares[window.y0 - y0 : window.y1 - y0, window.x0 - x0 : window.x1 - x0]
        costs = self._table[np.minimum(inner, len(self._table) - 1)]
        target = costmap.cells[window.slices]
        least = FREE_SPACE + 1 if self._inflate_unknown else INSCRIBED
        unknown = target == NO_INFORMATION
        if unknown.any():
            np.copyto(target, costs, where=np.where(unknown, costs >= least, costs > target))
        else:
            np.maximum(target, costs, out=target)
