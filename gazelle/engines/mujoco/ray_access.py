"""Cast rays that links of MuJoCo's worlds carry."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.engines.motion import Hits
from gazelle.engines.mujoco.rays import behind, nearest
from gazelle.engines.mujoco.running import RunningWorlds
from gazelle.engines.range_rays import RangeRays
from gazelle.engines.state import LinkRow, LinkRows
from gazelle.engines.table import Table
from gazelle.rotations import turns


class RayAccess:
    """The part of ``gazelle.engines.engine.Engine`` that casts rays.

    Args:
        run: Worlds that run.
        links: Links of all models.
    """

    def __init__(self, run: RunningWorlds, links: Table[LinkRow, LinkRows]) -> None:
        self._run, self._links = run, links

    def cast_rays(
        self,
        link: str,
        origins: Floats,
        directions: Floats,
        worlds: Worlds | None = None,
        *,
        ignore_own: bool = False,
    ) -> Hits:
        """Follow rays to the nearest collision shape; see the protocol."""
        place = self._links[link].placement(worlds)
        turn = turns(place.quaternion)
        start, along = place.position[:, None, :] + origins @ turn, directions @ turn
        body = self._run.layout.link(link).body if ignore_own else 0
        if ignore_own and not body:
            inside = f"{link}::"
            own = [
                geom
                for name, geoms in self._run.layout.collisions.items()
                if name.startswith(inside)
                for geom in geoms
            ]
            return behind(self._run.batch, start, along, worlds, own)
        return nearest(self._run.batch, start, along, worlds, body)[0]

    def cast_ranges(self, rays: RangeRays, worlds: Worlds | None = None) -> tuple[Floats, float]:
        """Follow rays of a range finder; see the protocol."""
        hits = self.cast_rays(rays.link, rays.origins, rays.directions, worlds)
        return np.where(hits.from_inside, -np.inf, hits.distance), 0.0

    def cast_ranges_together(
        self, links: Sequence[str], origins: Floats, directions: Floats
    ) -> tuple[Floats, float]:
        """Follow the rays of many range finders in one call; see the protocol."""
        place = self._links[tuple(links)].placement()
        turn = turns(place.quaternion.reshape(-1, 4)).reshape(-1, len(origins), 3, 3)
        start = place.position[:, :, None, :] + origins @ turn
        shape = start.shape
        along = (directions @ turn).reshape(shape[0], -1, 3)
        start = start.reshape(shape[0], -1, 3)
        hits = nearest(self._run.batch, start, along, None)[0]
        ranges = np.where(hits.from_inside, -np.inf, hits.distance)
        return ranges.reshape(shape[:3]), 0.0
