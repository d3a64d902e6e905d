"""Rays fixed to links, which may pass through the shapes of their link."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.engines.motion import Hits, Placement
from gazelle.engines.mujoco.compiler.shapes import CLOSED_GROUP, OPEN_GROUP
from gazelle.engines.mujoco.compiler.spec import COLLISION_GROUP
from gazelle.engines.mujoco.worlds import RunningWorlds
from gazelle.engines.range_rays import RangeRays
from gazelle.engines.state import LinkRow, LinkRows
from gazelle.engines.table import Table
from gazelle.native.ray_frames import CarriedRays
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


def meet(
    run: RunningWorlds,
    rays: CarriedRays,
    worlds: Worlds | None,
    excluded: int = 0,
    *,
    signed: bool = False,
) -> None:
    """Find the first hits of rays.

    Args:
        run: Worlds that run.
        rays: Aimed, ``beside`` where they should begin.
        worlds: Worlds.
        excluded: A body that rays pass through; the world's, 0, for none.
        signed: Whether to set distances to minus infinity where something is met from inside.
    """
    if excluded:
        rays.passed.fill(excluded)
    run.batch.meet(rays, _GROUPS, worlds)
    rays.settle(run.sheets, signed=signed)  # a sheet is met from both sides


def beside(run: RunningWorlds) -> Floats:
    """Return by how much rays start beside where they should [m], shape (3,)."""
    return BESIDE if run.compiled.model.nmesh else _NOWHERE


def meet_behind(
    run: RunningWorlds, rays: CarriedRays, worlds: Worlds | None, own: Sequence[int]
) -> Hits:
    """Return the first hits of rays, except on some geoms of the world's body.

    MuJoCo passes through whole bodies only. Rays that meet one of these continue behind it.
    """
    start, passed = rays.start.copy(), np.zeros(rays.distance.shape)
    for _ in range(_MOST_PASSED):
        rays.start[:] = start + passed[..., None] * rays.along
        meet(run, rays, worlds)
        met = np.isin(rays.geom, own)
        if not met.any():
            break
        passed = np.where(met, passed + rays.distance + _BEHIND, passed)
    return Hits(passed + rays.distance, rays.inside)


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
    cast = CarriedRays(origins, directions, len(place.position))
    at, turned = np.ascontiguousarray(place.position), np.ascontiguousarray(place.quaternion)
    cast.aim(at[:, None], turned[:, None], beside(run))
    body = run.layout.link(link).body if ignore_own else 0
    if ignore_own and not body:
        inside = f"{link}::"
        own = [
            geom
            for name, geoms in run.layout.collisions.items()
            if name.startswith(inside)
            for geom in geoms
        ]
        return meet_behind(run, cast, worlds, own)
    meet(run, cast, worlds, body)
    return Hits(cast.distance, cast.inside)


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
        self._rays = (
            np.array([each.origins for each in rays]),
            np.array([each.directions for each in rays]),
        )
        self._all: CarriedRays | None = None

    def cast(self, worlds: Worlds | None = None) -> Floats:
        """Return distances now [m], shape (n, finders, rays); the next call may overwrite them."""
        place, rays = self._links.placement(worlds), self._rays_in(worlds)
        at, turned = np.ascontiguousarray(place.position), np.ascontiguousarray(place.quaternion)
        rays.aim(at, turned, beside(self._run))
        meet(self._run, rays, worlds, signed=True)
        return rays.distance.reshape(-1, *self._rays[0].shape[:2])

    def _rays_in(self, worlds: Worlds | None) -> CarriedRays:
        """Return the rays for some worlds; those of all are kept."""
        if worlds is not None:
            return CarriedRays(*self._rays, len(worlds))
        if self._all is None:
            self._all = CarriedRays(*self._rays, self._run.nworld)
        return self._all
