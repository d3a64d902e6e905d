"""The layer of what sensors see, in space: columns of voxels over each cell."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Ints32
from gazelle.errors import Error
from gazelle.navigation.costmap.costmap import Costmap
from gazelle.navigation.costmap.obstacle_layer import Observation, ObservationSource, ObstacleLayer
from gazelle.navigation.costmap.values import LETHAL, CostmapBounds
from gazelle.navigation.costmap.voxel_rays import clear_voxels

_MOST_LAYERS = 16


@checked(Error, after=True)
class VoxelLayer(ObstacleLayer):
    """Obstacles that sensors see, in columns of up to 16 voxels.

    Args:
        name: Within the costmap.
        sources: Sensors by name.
        z_voxels: In a column.
        z_resolution: Height of one [m].
        origin_z: Of the lowest [m].
        unknown_threshold: Columns with more unknown voxels than this are unknown.
        mark_threshold: Columns with more marked voxels than this are obstacles.
        max_height: Points above are left out [m].
        footprint_clearing: Whether the robot stands on free ground by definition.
        overwrite: Write all that is known; else only raise costs.

    Raises:
        Error: There are more voxels than 16, or none.
    """

    def __init__(
        self,
        name: str = "voxel_layer",
        sources: Mapping[str, ObservationSource] | None = None,
        *,
        z_voxels: int = 10,
        z_resolution: float = 0.2,
        origin_z: float = 0.0,
        unknown_threshold: int = 15,
        mark_threshold: int = 0,
        max_height: float = 2.0,
        footprint_clearing: bool = True,
        overwrite: bool = False,
    ) -> None:
        super().__init__(
            name,
            sources,
            max_height=max_height,
            footprint_clearing=footprint_clearing,
            overwrite=overwrite,
        )
        if not 0 < z_voxels <= _MOST_LAYERS:
            raise Error(f"a column has 1 to {_MOST_LAYERS} voxels, not {z_voxels}")
        self._layers, self._side, self._bottom = z_voxels, z_resolution, origin_z
        # The original counts the voxels beyond z_voxels as unknown, too.
        unknown = unknown_threshold - (_MOST_LAYERS - z_voxels)
        self._limits = np.array([z_voxels, mark_threshold, max(unknown, 0)], np.int32)
        self._marks: Ints32 = np.zeros((0, 0), np.int32)
        self._unknown: Ints32 = np.zeros((0, 0), np.int32)

    def resized(self, costmap: Costmap) -> None:
        """Clear all observations."""
        super().resized(costmap)
        self._forget()

    def _forget(self) -> None:
        self._marks = np.zeros(self.cells.shape, np.int32)
        self._unknown = np.full(self.cells.shape, (1 << self._layers) - 1, np.int32)

    def moved(self, costmap: Costmap, columns: int, rows: int) -> None:
        """Keep the cells that remain in the window."""
        super().moved(costmap, columns, rows)
        high, wide = self.cells.shape
        kept = self._marks, self._unknown
        self._forget()
        if abs(columns) < wide and abs(rows) < high:
            for new, old in zip((self._marks, self._unknown), kept, strict=True):
                new[
                    max(-rows, 0) : high - max(rows, 0), max(-columns, 0) : wide - max(columns, 0)
                ] = old[
                    max(rows, 0) : high + min(rows, 0), max(columns, 0) : wide + min(columns, 0)
                ]

    def reset(self) -> None:
        """Clear all observations."""
        super().reset()
        self._forget()

    def clear_area(self, costmap: Costmap, area: CostmapBounds, *, outside: bool) -> None:
        """Clear the observations within an area, or outside of it."""
        super().clear_area(costmap, area, outside=outside)
        gone = np.full(self.cells.shape, outside)
        gone[costmap.window_of(area).slices] = not outside
        self._marks[gone] = 0
        self._unknown[gone] = (1 << self._layers) - 1

    def _scaled(self, costmap: Costmap, points: Floats) -> Floats:
        """Return columns, rows and layers of places, with their fractions."""
        corner = np.array([*costmap.origin, self._bottom])
        sides = np.array([costmap.resolution, costmap.resolution, self._side])
        return np.ascontiguousarray((points - corner) / sides)

    def _clear(
        self, costmap: Costmap, source: ObservationSource, seen: Observation, region: CostmapBounds
    ) -> None:
        if not len(seen.points) or costmap.cell_of(*seen.origin[:2].tolist()) is None:
            return
        ends = seen.points - seen.origin
        far = np.sqrt((ends**2).sum(axis=1))
        share = np.minimum(1.0, source.raytrace_range / np.maximum(far, 1e-9))
        clear_voxels(
            self._marks,
            self._unknown,
            self.cells,
            self._scaled(costmap, seen.origin[None])[0],
            self._scaled(costmap, seen.origin + share[:, None] * ends),
            self._limits,
        )
        self._touch(seen, source.raytrace_range, region)

    def _mark(
        self, costmap: Costmap, source: ObservationSource, seen: Observation, region: CostmapBounds
    ) -> None:
        away = ((seen.points - seen.origin) ** 2).sum(axis=1)
        kept = (away < source.obstacle_range**2) & (seen.points[:, 2] <= self._max_height)
        cells = np.floor(self._scaled(costmap, seen.points[kept])).astype(int)
        limit = np.array([*self.cells.shape[::-1], self._layers])
        column, row, layer = cells[((cells >= 0) & (cells < limit)).all(axis=1)].T
        bits = np.left_shift(1, layer).astype(np.int32)
        np.bitwise_or.at(self._marks, (row, column), bits)
        self._unknown[row, column] &= ~self._marks[row, column]
        enough = np.bitwise_count(self._marks[row, column]) > self._limits[1]
        self.cells[row[enough], column[enough]] = LETHAL
        self._touch(seen, source.obstacle_range, region)
