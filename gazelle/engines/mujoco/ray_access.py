"""Cast rays that links of MuJoCo's worlds carry."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.engines.motion import Hits, Placement
from gazelle.engines.mujoco.rays import behind, beside, nearest
from gazelle.engines.mujoco.running import RunningWorlds
from gazelle.engines.range_rays import RangeRays
from gazelle.engines.state import LinkRow, LinkRows
from gazelle.engines.table import Table
from gazelle.native.ray_frames import carried_rays
from gazelle.native.system import System


def cast_from(
    run: RunningWorlds,
    link: str,
    place: Placement,
    rays: tuple[Floats, Floats],
    worlds: Worlds | None,
    *,
    ignore_own: bool,
) -> Hits:
    """Follow rays of a link to the nearest collision shape.

    Args:
        run: Worlds that run.
        link: Scoped name.
        place: Pose of the link.
        rays: Origins and directions in its frame, shapes (rays, 3).
        worlds: Which worlds.
        ignore_own: Whether rays pass through the shapes of the link.
    """
    origins, directions = (np.ascontiguousarray(each, np.float64)[None] for each in rays)
    at, turned = place.position[:, None], place.quaternion[:, None]
    start, along = carried_rays(at, turned, origins, directions, beside(run))
    body = run.layout.link(link).body if ignore_own else 0
    if ignore_own and not body:
        inside = f"{link}::"
        own = [
            geom
            for name, geoms in run.layout.collisions.items()
            if name.startswith(inside)
            for geom in geoms
        ]
        return behind(run, start, along, worlds, own)
    return nearest(run, start, along, worlds, body)[0]


class RangeFinders:
    """The part of ``gazelle.engines.engine.Engine`` for range finders.

    Args:
        run: Worlds that run.
        links: Links of all models.
    """

    def __init__(self, run: RunningWorlds, links: Table[LinkRow, LinkRows]) -> None:
        self._run, self._links = run, links

    def range_kind(self, rays: RangeRays) -> Hashable | None:
        """Return what is equal for rays that ``range_table`` casts together."""
        return len(rays.origins)

    def range_table(self, rays: Sequence[RangeRays]) -> MujocoRanges:
        """Return a table of range finders of one kind."""
        return MujocoRanges(self._run, self._links, rays)


class MujocoRanges:
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
        self._origins = np.array([each.origins for each in rays])
        self._directions = np.array([each.directions for each in rays])

    def cast(self, worlds: Worlds | None = None) -> Floats:
        """Return distances now [m], shape (n, finders, rays)."""
        place = self._links.placement(worlds)
        rays = self._origins, self._directions, beside(self._run)
        start, along = carried_rays(place.position, place.quaternion, *rays)
        hits = nearest(self._run, start, along, worlds)[0]
        hits.distance[hits.from_inside] = -np.inf
        return hits.distance.reshape(-1, *self._origins.shape[:2])
