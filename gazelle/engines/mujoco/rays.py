"""Rays fixed to links, which may pass through the shapes of their link."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.engines.motion import Hits, Placement
from gazelle.engines.mujoco.compiler.shapes import CLOSED_GROUP, OPEN_GROUP
from gazelle.engines.mujoco.compiler.spec import COLLISION_GROUP
from gazelle.engines.mujoco.worlds import RunningWorlds
from gazelle.engines.range_rays import RangeRays
from gazelle.engines.state import LinkRow, LinkRows
from gazelle.engines.table import Table
from gazelle.native.ray_frames import carried_rays, met_from_inside
from gazelle.native.system import System

_SEEN = (COLLISION_GROUP, CLOSED_GROUP, OPEN_GROUP)
_GROUPS = np.array([group in _SEEN for group in range(6)], dtype=np.uint8)

# By this rays start beside where they should [m]. MuJoCo's pass between two triangles of a mesh
# if they meet the edge but for single precision, as the middle of a symmetric thing is met.
BESIDE = 3e-6 * np.array([0.613, 0.371, 0.697])
_NOWHERE = np.zeros(3)

# How far behind a surface that is passed through a ray continues [m].
_BEHIND = 1e-6
_MOST_PASSED = 8


def nearest(
    run: RunningWorlds, start: Floats, along: Floats, worlds: Worlds | None, excluded: int = 0
) -> tuple[Hits, NDArray[np.int32]]:
    """Return the first hits of rays, and the geoms hit (-1 for nothing).

    Args:
        run: Worlds that run.
        start: In the world frame, ``beside`` where they should begin [m], shape (n, rays, 3).
        along: Unit vectors, shape (n, rays, 3).
        worlds: Worlds.
        excluded: A body that rays pass through; the world's, 0, for none.
    """
    distance, geom, normal = run.batch.ray(
        start,
        along,
        geomgroup=_GROUPS,
        bodyexclude=excluded or -1,
        ids=worlds,
        normal=True,
    )
    distance, normal = (np.ascontiguousarray(each, np.float64) for each in (distance, normal))
    geom = np.ascontiguousarray(geom, np.int32)
    # A sheet is met from both sides.
    sheets = run.sheets
    return Hits(distance, met_from_inside(distance, normal, along, geom, sheets)), geom


def beside(run: RunningWorlds) -> Floats:
    """Return by how much rays start beside where they should [m], shape (3,)."""
    return BESIDE if run.compiled.model.nmesh else _NOWHERE


def behind(
    run: RunningWorlds, start: Floats, along: Floats, worlds: Worlds | None, own: Sequence[int]
) -> Hits:
    """Return the first hits of rays, except on some geoms of the world's body.

    MuJoCo passes through whole bodies only. Rays that meet one of these continue behind it.
    """
    passed = np.zeros(along.shape[:2])
    for _ in range(_MOST_PASSED):
        hits, geom = nearest(run, start + passed[..., None] * along, along, worlds)
        met = np.isin(geom, own)
        if not met.any():
            break
        passed = np.where(met, passed + hits.distance + _BEHIND, passed)
    return Hits(passed + hits.distance, hits.from_inside)


def cast_from(
    run: RunningWorlds,
    link: str,
    place: Placement,
    rays: tuple[Floats, Floats],
    worlds: Worlds | None,
    *,
    ignore_own: bool,
) -> Hits:
    """Cast rays of a link to the nearest collision shape.

    Args:
        run: Worlds that run.
        link: Scoped name.
        place: Pose of the link.
        rays: Origins and directions in its frame, shapes (rays, 3).
        worlds: Worlds.
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
