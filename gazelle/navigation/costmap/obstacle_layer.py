"""The obstacle layer: marks sensor hits as obstacles, and clears the cells before them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Bytes, Floats
from gazelle.errors import Error
from gazelle.navigation.costmap.costmap import Costmap, Layer, raise_to, roll
from gazelle.navigation.costmap.footprint import cells_under, placed
from gazelle.navigation.costmap.rays import clear_rays
from gazelle.navigation.costmap.values import (
    FREE_SPACE,
    LETHAL,
    NO_INFORMATION,
    CostmapBounds,
    Window,
)
from gazelle.navigation.following import Pose2


@dataclass(frozen=True, slots=True)
class Observation:
    """Sensor reading at one time.

    Attributes:
        time: Time [s].
        origin: Of the sensor in the costmap's frame [m], shape (3,).
        points: Observed points, likewise, shape (n, 3).
    """

    time: float
    origin: Floats
    points: Floats


@checked(Error)
@dataclass(slots=True)
class ObservationSource:
    """An observation source: a sensor, and the ranges and heights of its points that are used.

    Attributes:
        marking: Whether what it sees is an obstacle.
        clearing: Whether what is before that is free.
        obstacle_range: Points farther off are no obstacles [m].
        raytrace_range: Range up to which space is cleared [m].
        min_height: Points below are left out [m].
        max_height: Points above, too.
        persistence: Time to keep observations [s]; 0 for the last one only.
        observations: Those that count, oldest first.
    """

    marking: bool = True
    clearing: bool = False
    obstacle_range: float = 2.5
    raytrace_range: float = 3.0
    min_height: float = 0.0
    max_height: float = 2.0
    persistence: float = 0.0
    observations: list[Observation] = field(default_factory=list)

    def add(self, seen: Observation) -> None:
        """Add an observation."""
        z = seen.points[:, 2]
        kept = seen.points[(z >= self.min_height) & (z <= self.max_height)]
        seen = Observation(seen.time, seen.origin, kept)
        if self.persistence > 0.0:
            self.observations = [
                each
                for each in self.observations
                if 0.0 <= seen.time - each.time <= self.persistence
            ]
            self.observations.append(seen)
        else:
            self.observations = [seen]


@checked(Error, after=True)
class ObstacleLayer(Layer):
    """Obstacles that sensors see, in the plane.

    Args:
        name: Within the costmap.
        sources: Sensors by name.
        max_height: Points above are left out, whatever the source sets [m].
        footprint_clearing: Whether the robot stands on free ground by definition.
        overwrite: Write all that is known; else only raise costs (``combination_method`` 0, 1).
    """

    def __init__(
        self,
        name: str = "obstacle_layer",
        sources: Mapping[str, ObservationSource] | None = None,
        *,
        max_height: float = 2.0,
        footprint_clearing: bool = True,
        overwrite: bool = False,
    ) -> None:
        super().__init__(name)
        self.sources = dict(sources or {})
        self._max_height = max_height
        self._footprint_clearing, self._overwrite = footprint_clearing, overwrite
        self.cells: Bytes = np.zeros((0, 0), np.uint8)
        self._outline: Floats = np.zeros((0, 2))
        self._all = False

    def observe(self, source: str, time: float, origin: Floats, points: Floats) -> None:
        """Add an observation of a sensor.

        Args:
            source: Its name.
            time: Time [s].
            origin: Of the sensor in the costmap's frame [m], shape (3,).
            points: Likewise, shape (n, 3).
        """
        self.sources[source].add(Observation(time, origin, points))

    def resized(self, costmap: Costmap) -> None:
        """Clear all observations."""
        self.cells = np.full(costmap.cells.shape, costmap.default, np.uint8)

    def moved(self, costmap: Costmap, columns: int, rows: int) -> None:
        """Keep the cells that remain in the window."""
        roll(self.cells, columns, rows, costmap.default)
        self._all = True

    def reset(self) -> None:
        """Clear all observations."""
        self.cells.fill(FREE_SPACE)
        for source in self.sources.values():
            source.observations.clear()
        self._all = True

    def clear_area(self, costmap: Costmap, area: CostmapBounds, *, outside: bool) -> None:
        """Clear the observations within an area, or outside of it."""
        window = costmap.window_of(area)
        if outside:
            kept = self.cells[window.slices].copy()
            self.cells.fill(costmap.default)
            self.cells[window.slices] = kept
        else:
            self.cells[window.slices] = costmap.default
        self._all = True

    def update_bounds(self, costmap: Costmap, pose: Pose2, region: CostmapBounds) -> None:
        """Draw all observations onto the layer."""
        seen = [(source, each) for source in self.sources.values() for each in source.observations]
        for source, each in seen:
            if source.clearing:
                self._clear(costmap, source, each, region)
        for source, each in seen:
            if source.marking:
                self._mark(costmap, source, each, region)
        self._outline = placed(costmap.footprint, *pose)
        for x, y in self._outline:
            region.touch(float(x), float(y))
        if self._all or costmap.rolling:
            rows, columns = self.cells.shape
            region.touch(*costmap.place_of(0, 0))
            region.touch(*costmap.place_of(columns - 1, rows - 1))
            self._all = False

    def update_costs(self, costmap: Costmap, window: Window) -> None:
        """Write the observations."""
        if self._footprint_clearing:
            _fill(self.cells, costmap, self._outline, FREE_SPACE)
        layer, target = self.cells[window.slices], costmap.cells[window.slices]
        if self._overwrite:
            np.copyto(target, layer, where=layer != NO_INFORMATION)
        else:
            raise_to(target, layer)

    def _clear(
        self, costmap: Costmap, source: ObservationSource, seen: Observation, region: CostmapBounds
    ) -> None:
        """Clear the cells between a sensor and its hits."""
        start = costmap.cell_of(float(seen.origin[0]), float(seen.origin[1]))
        if start is None or not len(seen.points):
            return
        corner, side = np.array(costmap.origin), costmap.resolution
        ends = np.floor((seen.points[:, :2] - corner) / side)
        clear_rays(self.cells, start, ends, math.ceil(source.raytrace_range / side))
        self._touch(seen, source.raytrace_range, region)

    def _mark(
        self, costmap: Costmap, source: ObservationSource, seen: Observation, region: CostmapBounds
    ) -> None:
        """Mark a sensor's hits as obstacles."""
        away = ((seen.points - seen.origin) ** 2).sum(axis=1)
        kept = (away < source.obstacle_range**2) & (seen.points[:, 2] <= self._max_height)
        points = seen.points[kept]
        corner = np.array(costmap.origin)
        cells = np.floor((points[:, :2] - corner) / costmap.resolution).astype(int)
        limit = np.array(self.cells.shape[::-1])
        on_map = ((cells >= 0) & (cells < limit)).all(axis=1)
        self.cells[cells[on_map, 1], cells[on_map, 0]] = LETHAL
        self._touch(seen, source.obstacle_range, region)

    @staticmethod
    def _touch(seen: Observation, reach: float, region: CostmapBounds) -> None:
        """Extend the region by an observation, within its range."""
        origin = seen.origin[:2]
        ends = seen.points[:, :2] - origin
        far = np.hypot(ends[:, 0], ends[:, 1])
        ends = origin + ends * np.minimum(1.0, reach / np.maximum(far, 1e-9))[:, None]
        for x, y in (origin, *((ends.min(axis=0), ends.max(axis=0)) if len(ends) else ())):
            region.touch(float(x), float(y))


def _fill(cells: Bytes, costmap: Costmap, outline: Floats, cost: int) -> None:
    """Set the cost of all cells under a robot."""
    corners = np.floor((outline - np.array(costmap.origin)) / costmap.resolution).astype(np.intp)
    columns, rows = cells_under(corners)
    high, wide = cells.shape
    on_map = (columns >= 0) & (rows >= 0) & (columns < wide) & (rows < high)
    cells[rows[on_map], columns[on_map]] = cost
