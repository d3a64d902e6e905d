"""A layered costmap: the cost of a robot in each cell of a grid."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Bytes, Floats
from gazelle.errors import Error
from gazelle.navigation.costmap.footprint import radii_of
from gazelle.navigation.costmap.values import FREE_SPACE, NO_INFORMATION, CostmapBounds, Window
from gazelle.navigation.following import Pose2

_MOST_CELLS = 16_384


class Layer(ABC):
    """Layer of a costmap: one source of knowledge about the cells.

    Attributes:
        name: Within the costmap.
        enabled: Whether it counts.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self.enabled = True

    def resized(self, costmap: Costmap) -> None:  # noqa: B027  # most need not
        """Handle a new size of the costmap; called once when the layer is added, too."""

    def moved(self, costmap: Costmap, columns: int, rows: int) -> None:  # noqa: B027  # most need not
        """Handle a shift of a rolling costmap by cells along x and y."""

    def footprint_changed(self, costmap: Costmap) -> None:  # noqa: B027  # most need not
        """Handle a new footprint of the robot."""

    @abstractmethod
    def update_bounds(self, costmap: Costmap, pose: Pose2, region: CostmapBounds) -> None:
        """Extend the region by the changed cells."""

    @abstractmethod
    def update_costs(self, costmap: Costmap, window: Window) -> None:
        """Write costs into ``costmap.cells``, within the window only."""

    def reset(self) -> None:  # noqa: B027  # most need not
        """Clear the observations."""

    def clear_area(self, costmap: Costmap, area: CostmapBounds, *, outside: bool) -> None:  # noqa: B027  # most need not
        """Clear the observations within an area, or outside of it."""


@checked(Error, after=True)
class Costmap:
    """Layers, one on the other, on a grid.

    Args:
        layers: Bottom first.
        footprint: Corners of the robot, padded [m], shape (n, 2).
        width: Along x [m].
        height: Along y [m].
        resolution: Side of a cell [m].
        origin: Of the lower left corner (x, y) [m].
        rolling: Whether it moves along with the robot, which is then in its middle.
        track_unknown: Whether cells that nothing is known of are unknown; else they are free.
        frame: Its frame.

    Attributes:
        cells: Costs, shape (rows, columns), row 0 the lowest.
        origin: Of the lower left corner (x, y) [m].
        inscribed: Radius of the largest circle within the footprint [m].
        circumscribed: Radius of the smallest circle around it [m].
        updated: The cells of the last update.

    Raises:
        Error: The size or the resolution is invalid.
    """

    def __init__(
        self,
        layers: Sequence[Layer],
        footprint: Floats,
        *,
        width: float = 10.0,
        height: float = 10.0,
        resolution: float = 0.05,
        origin: tuple[float, float] = (0.0, 0.0),
        rolling: bool = False,
        track_unknown: bool = False,
        frame: str = "map",
    ) -> None:
        self.frame = frame
        self.rolling, self.track_unknown = rolling, track_unknown
        self.layers: list[Layer] = []
        self.updated = Window(0, 0, 0, 0)
        self.set_footprint(footprint)
        if not resolution > 0.0:
            raise Error(f"the resolution of a costmap must be positive, not {resolution:g}")
        if not all(map(math.isfinite, (width, height, *origin))):
            raise Error(
                f"a costmap has a finite size and origin, not {width:g} m x {height:g} m at "
                f"({origin[0]:g}, {origin[1]:g})"
            )
        columns, rows = (
            math.floor(min(side / resolution + 1e-6, _MOST_CELLS + 1.0)) for side in (width, height)
        )
        self.resize(rows, columns, resolution, origin)
        for layer in layers:
            self.layers.append(layer)
            layer.resized(self)

    @property
    def default(self) -> int:
        """Cost of unknown cells."""
        return NO_INFORMATION if self.track_unknown else FREE_SPACE

    @checked(Error)
    def resize(
        self, rows: int, columns: int, resolution: float, origin: tuple[float, float]
    ) -> None:
        """Set another size; all content is discarded.

        Raises:
            Error: There would be no cells, or too many.
        """
        if not (0 < rows <= _MOST_CELLS and 0 < columns <= _MOST_CELLS):
            raise Error(f"a costmap has 1 to {_MOST_CELLS} cells a side, not {columns} x {rows}")
        self.cells: Bytes = np.full((rows, columns), self.default, np.uint8)
        self.resolution, self.origin = resolution, origin
        for layer in self.layers:
            layer.resized(self)

    def set_footprint(self, footprint: Floats) -> None:
        """Set another outline of the robot, padded [m], shape (n, 2)."""
        self.footprint = footprint
        self.inscribed, self.circumscribed = radii_of(footprint)
        for layer in self.layers:
            layer.footprint_changed(self)

    # Places -------------------------------------------------------------------------------

    def cell_of(self, x: float, y: float) -> tuple[int, int] | None:
        """Return column and row of a place; None off the map."""
        column = math.floor((x - self.origin[0]) / self.resolution)
        row = math.floor((y - self.origin[1]) / self.resolution)
        rows, columns = self.cells.shape
        return (column, row) if 0 <= column < columns and 0 <= row < rows else None

    def place_of(self, column: float, row: float) -> tuple[float, float]:
        """Return the middle of a cell (x, y) [m]; of NaN NaN."""
        return (
            self.origin[0] + (column + 0.5) * self.resolution,
            self.origin[1] + (row + 0.5) * self.resolution,
        )

    def cost_at(self, x: float, y: float) -> int:
        """Return the cost of a place; unknown off the map."""
        cell = self.cell_of(x, y)
        return NO_INFORMATION if cell is None else int(self.cells[cell[1], cell[0]])

    def window_of(self, region: CostmapBounds) -> Window:
        """Return the cells of a region that are on the map."""
        rows, columns = self.cells.shape
        if not region.x0 <= region.x1 or not region.y0 <= region.y1:
            return Window(0, 0, 0, 0)
        x0, y0 = self.origin
        side = self.resolution

        def bound(value: float, corner: float, count: int) -> int:
            return math.floor(min(max((value - corner) / side, -1.0), count + 1.0))

        first_x, first_y = bound(region.x0, x0, columns), bound(region.y0, y0, rows)
        last_x, last_y = bound(region.x1, x0, columns) + 1, bound(region.y1, y0, rows) + 1
        return Window(
            min(max(first_x, 0), columns),
            min(max(first_y, 0), rows),
            min(max(last_x, 0), columns),
            min(max(last_y, 0), rows),
        )

    # Updates ------------------------------------------------------------------------------

    def update(self, pose: Pose2) -> Window:
        """Merge all changes of layers into the map; returns the cells that may have changed.

        Args:
            pose: Of the robot, in the frame of the costmap.
        """
        if self.rolling:
            self._follow(pose)
        region = CostmapBounds()
        enabled = [layer for layer in self.layers if layer.enabled]
        for layer in enabled:
            layer.update_bounds(self, pose, region)
        window = self.window_of(region)
        if window.x0 < window.x1 and window.y0 < window.y1:
            self.cells[window.slices] = self.default
            for layer in enabled:
                layer.update_costs(self, window)
        self.updated = window
        return window

    def reset(self) -> None:
        """Clear the observations; layers without any keep their content."""
        self.cells.fill(self.default)
        for layer in self.layers:
            layer.reset()

    @checked(Error)
    def clear(
        self, pose: Pose2, side: float, names: Sequence[str], *, outside: bool = True
    ) -> None:
        """Clear observations of some layers outside a square about the robot, or within it.

        Args:
            pose: Of the robot.
            side: Of the square [m].
            names: Of the layers; others keep what they know.
            outside: Forget what is outside; else what is within.
        """
        half = side / 2.0
        area = CostmapBounds(pose[0] - half, pose[1] - half, pose[0] + half, pose[1] + half)
        for layer in self.layers:
            if layer.name in names:
                layer.clear_area(self, area, outside=outside)

    def _follow(self, pose: Pose2) -> None:
        """Move the window so that the robot is in its middle, by whole cells."""
        rows, columns = self.cells.shape
        side = self.resolution
        wished = pose[0] - columns * side / 2.0, pose[1] - rows * side / 2.0
        along = math.floor((wished[0] - self.origin[0]) / side)
        aside = math.floor((wished[1] - self.origin[1]) / side)
        self.origin = self.origin[0] + along * side, self.origin[1] + aside * side
        if along or aside:
            roll(self.cells, along, aside, self.default)
            for layer in self.layers:
                layer.moved(self, along, aside)


def roll(cells: Bytes, columns: int, rows: int, default: int) -> None:
    """Shift the content of a grid against the motion of its window; new cells are ``default``."""
    high, wide = cells.shape
    kept = cells.copy()
    cells.fill(default)
    if abs(columns) >= wide or abs(rows) >= high:
        return
    to_x, from_x = max(-columns, 0), max(columns, 0)
    to_y, from_y = max(-rows, 0), max(rows, 0)
    count_x, count_y = wide - abs(columns), high - abs(rows)
    cells[to_y : to_y + count_y, to_x : to_x + count_x] = kept[
        from_y : from_y + count_y, from_x : from_x + count_x
    ]


def raise_to(cells: Bytes, layer: Bytes) -> None:
    """Write a layer's costs where they are higher, in place; unknown cells change nothing."""
    better = (layer != NO_INFORMATION) & ((cells == NO_INFORMATION) | (cells < layer))
    np.copyto(cells, layer, where=better)
