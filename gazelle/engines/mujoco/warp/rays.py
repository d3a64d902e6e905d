"""Range finders with rays that are cast on the device."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.engines.mujoco.rays import joined, meet, ray_offset
from gazelle.engines.mujoco.worlds import RunningWorlds
from gazelle.engines.range_rays import RangeRays
from gazelle.engines.state import LinkRow, LinkRows
from gazelle.engines.table import Table
from gazelle.native.ray_frames import FrameRays
from gazelle.native.system import System


class WarpRanges:
    """Range finders with as many rays each; see ``gazelle.engines.range_rays.RangeTable``.

    Args:
        run: Worlds that run.
        links: Links of all models.
        rays: Rays of each range finder.
    """

    system: System | None = None
    ranges: Floats = np.zeros((0, 0))
    begin = 0.0

    def __init__(
        self, run: RunningWorlds, links: Table[LinkRow, LinkRows], rays: Sequence[RangeRays]
    ) -> None:
        self._run, self._links = run, links[tuple(each.link for each in rays)]
        self._rays = joined(rays)
        self._all: FrameRays | None = None

    def cast(self, worlds: Worlds | None = None) -> Floats:
        """Return distances now [m], shape (n, finders, rays); the next call may overwrite them."""
        place, rays = self._links.placement(worlds), self._rays_in(worlds)
        at, turned = np.ascontiguousarray(place.position), np.ascontiguousarray(place.quaternion)
        rays.aim(at, turned, ray_offset(self._run))
        meet(self._run, rays, worlds, signed=True)
        return rays.distance.reshape(-1, *self._rays[0].shape[:2])

    def _rays_in(self, worlds: Worlds | None) -> FrameRays:
        """Return the rays for some worlds; those of all are kept."""
        if worlds is not None:
            return FrameRays(*self._rays, len(worlds))
        if self._all is None:
            self._all = FrameRays(*self._rays, self._run.nworld)
        return self._all
