"""MuJoCo's batch of worlds, with rays that frames carry."""

from __future__ import annotations

import numpy as np
from mujoco import batch
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.native.ray_frames import FrameRays


class WorldBatch(batch.Batch):  # type: ignore[misc]  # MuJoCo has no types
    """Many copies of a model; see MuJoCo's."""

    def meet(self, rays: FrameRays, groups: NDArray[np.uint8], worlds: Worlds | None) -> None:
        """Find what rays meet: their distances, -1 for nothing, geoms and normals.

        Args:
            rays: Aimed, for as many worlds.
            groups: Whether geoms of a group are met, shape (groups,).
            worlds: Worlds; all if None.
        """
        rays.distance[:], rays.geom[:], rays.normal[:] = self.ray(
            rays.start, rays.along, groups, bodyexclude=rays.passed, ids=worlds, normal=True
        )
