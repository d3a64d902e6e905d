"""MuJoCo's batch of worlds, with rays in arrays that are used again."""

from __future__ import annotations

import numpy as np
from mujoco import batch
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.native.ray_frames import CarriedRays


class WorldBatch(batch.Batch):  # type: ignore[misc]  # MuJoCo has no types
    """Many copies of a model; see MuJoCo's."""

    def meet(self, rays: CarriedRays, groups: NDArray[np.uint8], worlds: Worlds | None) -> None:
        """Find what rays meet: their distances, -1 for nothing, geoms and normals.

        It is ``ray`` without its checks and copies, which cost a lidar of a single world more than its
        24 rays.

        Args:
            rays: Aimed, for as many worlds.
            groups: Whether geoms of a group are met, shape (groups,).
            worlds: Worlds; all if None.
        """
        ids = None if worlds is None else batch._ids(worlds, self.nsim)  # noqa: SLF001  its own
        arrays = rays.start, rays.along, groups, True, rays.passed
        failed = self._b.ray(ids, *arrays, rays.distance, rays.geom, rays.normal)
        if failed:
            self._check(ids, failed)
