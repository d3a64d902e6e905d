"""Cast rays that links of MuJoCo's worlds carry."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.engines.motion import Hits, Placement
from gazelle.engines.mujoco.rays import behind, nearest
from gazelle.engines.mujoco.running import RunningWorlds
from gazelle.engines.range_rays import RangeRays
from gazelle.engines.state import LinkRow, LinkRows
from gazelle.engines.table import Table
from gazelle.native.system import System
from gazelle.rotations import turns


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
    turn = turns(place.quaternion)
    start, along = place.position[:, None, :] + rays[0] @ turn, rays[1] @ turn
    body = run.layout.link(link).body if ignore_own else 0
    if ignore_own and not body:
        inside = f"{link}::"
        own = [
            geom
            for name, geoms in run.layout.collisions.items()
            if name.startswith(inside)
            for geom in geoms
        ]
        return behind(run.batch, start, along, worlds, own)
    return nearest(run.batch, start, along, worlds, body)[0]


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
        turn = turns(place.quaternion.reshape(-1, 4)).reshape(-1, len(self._origins), 3, 3)
        start = place.position[:, :, None, :] + self._origins @ turn
        along = self._directions @ turn
        shape = start.shape
        flat = (shape[0], shape[1] * shape[2], 3)
        hits = nearest(self._run.batch, start.reshape(flat), along.reshape(flat), worlds)[0]
        return np.where(hits.from_inside, -np.inf, hits.distance).reshape(shape[:3])
