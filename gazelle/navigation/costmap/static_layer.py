"""The layer of a map that is given."""

from __future__ import annotations

import math

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Bytes
from gazelle.description.occupancy import OccupancyMap
from gazelle.errors import Error
from gazelle.navigation.costmap.costmap import Costmap, Layer, raise_to
from gazelle.navigation.costmap.values import (
    FREE_SPACE,
    LETHAL,
    NO_INFORMATION,
    CostmapBounds,
    Window,
)
from gazelle.navigation.following import Pose2


@checked(Error, after=True)
class StaticLayer(Layer):
    """A given map.

    Args:
        name: Within the costmap.
        lethal: Cells of the map from this value on are obstacles.
        unknown: The value of unknown cells.
        trinary: Whether cells between are free; else they cost in proportion.
        use_maximum: Whether it only raises costs; else it overwrites what is below.

    Attributes:
        to_map: Pose of the costmap's frame in the map's; only rolling costmaps may differ.
    """

    def __init__(
        self,
        name: str = "static_layer",
        *,
        lethal: int = 100,
        unknown: int = -1,
        trinary: bool = True,
        use_maximum: bool = False,
    ) -> None:
        super().__init__(name)
        self._lethal, self._unknown = max(min(lethal, 100), 0), unknown
        self._trinary, self._use_maximum = trinary, use_maximum
        self._map: OccupancyMap | None = None
        self._costs: Bytes = np.zeros((0, 0), np.uint8)
        self._changed: CostmapBounds | None = None
        self.to_map: Pose2 = (0.0, 0.0, 0.0)

    @property
    def current(self) -> bool:
        """True once there is a map."""
        return self._map is not None

    def set_map(self, grid: OccupancyMap, costmap: Costmap) -> None:
        """Set a map; a costmap that does not roll gets its size."""
        self._map = grid
        self._costs = self._interpreted(grid, track_unknown=costmap.track_unknown)
        origin = grid.origin.x, grid.origin.y
        same = (costmap.cells.shape, costmap.resolution, costmap.origin) == (
            grid.data.shape,
            grid.resolution,
            origin,
        )
        if not costmap.rolling and not same:
            costmap.resize(grid.height, grid.width, grid.resolution, origin)
        self._changed = self._extent()

    def _interpreted(self, grid: OccupancyMap, *, track_unknown: bool) -> Bytes:
        """Return the cost of each value, as in costmap_2d."""
        values = np.arange(256).astype(np.uint8).view(np.int8).astype(int)
        if self._trinary:
            table = np.where(values >= self._lethal, LETHAL, FREE_SPACE)
        else:
            share = np.clip(values / max(self._lethal, 1), 0.0, 1.0)
            table = np.where(values >= self._lethal, LETHAL, (share * LETHAL).astype(int))
        # The original compares unsigned numbers: what is negative is above any threshold.
        table[values < 0] = LETHAL
        table[values == self._unknown] = NO_INFORMATION if track_unknown else FREE_SPACE
        costs: Bytes = table.astype(np.uint8)[grid.data.view(np.uint8)]
        return costs

    def _extent(self) -> CostmapBounds:
        grid = self._map
        if grid is None:
            return CostmapBounds()
        wide, high = grid.size
        x, y = grid.origin.x, grid.origin.y
        return CostmapBounds(x, y, x + wide, y + high)

    def resized(self, costmap: Costmap) -> None:
        """Mark everything as changed."""
        del costmap
        self._changed = self._extent()

    def reset(self) -> None:
        """Keep the map, and mark it as changed."""
        self._changed = self._extent()

    def update_bounds(self, costmap: Costmap, pose: Pose2, region: CostmapBounds) -> None:
        """Extend the bounds to everything when the map is new or the window moves."""
        del pose
        if self._map is None:
            return
        if costmap.rolling:
            rows, columns = costmap.cells.shape
            region.touch(*costmap.place_of(0, 0))
            region.touch(*costmap.place_of(columns - 1, rows - 1))
        elif self._changed is not None:
            region.touch(self._changed.x0, self._changed.y0)
            region.touch(self._changed.x1, self._changed.y1)
        self._changed = None

    def update_costs(self, costmap: Costmap, window: Window) -> None:
        """Write the costs of the map."""
        if self._map is None:
            return
        target = costmap.cells[window.slices]
        costs = self._seen(costmap, window) if costmap.rolling else self._costs[window.slices]
        if self._use_maximum:
            raise_to(target, costs)
        else:
            known = costs != NO_INFORMATION if costmap.rolling else np.True_
            np.copyto(target, costs, where=known)

    def _seen(self, costmap: Costmap, window: Window) -> Bytes:
        """Return the map at the middles of the cells of a window."""
        grid = self._map
        side = costmap.resolution
        x = costmap.origin[0] + (np.arange(window.x0, window.x1) + 0.5) * side
        y = (costmap.origin[1] + (np.arange(window.y0, window.y1) + 0.5) * side)[:, None]
        cos, sin = math.cos(self.to_map[2]), math.sin(self.to_map[2])
        costs = np.full((window.y1 - window.y0, window.x1 - window.x0), NO_INFORMATION, np.uint8)
        if grid is None:
            return costs
        at_x = self.to_map[0] + cos * x - sin * y - grid.origin.x
        at_y = self.to_map[1] + sin * x + cos * y - grid.origin.y
        column = np.floor(at_x / grid.resolution).astype(int)
        row = np.floor(at_y / grid.resolution).astype(int)
        inside = (column >= 0) & (row >= 0) & (column < grid.width) & (row < grid.height)
        costs[inside] = self._costs[row[inside], column[inside]]
        return costs
