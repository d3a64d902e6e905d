"""Follow the rays of sensors through a planar world."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Sequence
from dataclasses import replace

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.fans import Scanner
from gazelle.engines.planar.ray_fans import (
    CachedCaster,
    Caster,
    RayFan,
    caster_of,
    check_level,
    fan_of,
)
from gazelle.engines.planar.worlds import PlanarState
from gazelle.engines.range_rays import RangeRays
from gazelle.errors import EngineError
from gazelle.native.system import System
from gazelle.rotations import multiply, rotate


class PlanarRays:
    """The part of ``gazelle.engines.engine.Engine`` that casts rays.

    Args:
        run: Running worlds.
        make_kinematic: The engine's; a sensor needs a body to sit on.
    """

    def __init__(self, run: PlanarState, make_kinematic: Callable[[str], None]) -> None:
        self._run, self._make_kinematic = run, make_kinematic
        self._casters: dict[tuple[str, bytes, bytes, float], CachedCaster] = {}
        run.on_change.append(self._casters.clear)

    def caster(self, link: str, origins: Floats, directions: Floats) -> Caster:
        """Return the caster of ``LinkRow.cast_rays``: the same one as long as nothing turns its link.

        Raises:
            EngineError: The rays are not level, or their link not the same in all worlds.
        """
        return self.keep(RangeRays(link, origins, directions)).caster

    def keep(self, rays: RangeRays) -> CachedCaster:
        """Return a cached caster, or one that is cached from now on."""
        link, origins, directions = rays.link, rays.origins, rays.directions
        key = (link, origins.tobytes(), directions.tobytes(), rays.reach)
        kept = self._casters.get(key)
        if kept is not None and kept.holds(self._run.angles):
            return kept if kept.of is origins else replace(kept, of=origins, along=directions)
        caster = caster_of(self._run.fleet, self.rays_on_body(rays))
        model = self._run.owner(link)
        columns = self._run.layout.columns[model] + self._run.model(model).tree.columns_of(link)
        angles = self._run.angles[:, columns].copy() if len(columns) else self._run.angles[:0]
        kept = self._casters[key] = CachedCaster(caster, columns, angles, origins, directions)
        return kept

    def range_kind(self, rays: RangeRays) -> Hashable | None:
        """Return a key that is equal for rays that ``range_table`` can cast together."""
        try:
            found = self.rays_on_body(rays)
        except EngineError:
            return None
        tree = self._run.model(self._run.owner(rays.link)).tree
        if len(found.mounts) > 1 or len(tree.columns_of(rays.link)):
            return None
        return found.fan, found.begin

    def range_table(self, rays: Sequence[RangeRays]) -> PlanarRanges:
        """Return a table of range finders of one kind, or of a single one."""
        return PlanarRanges(self, self._run, rays)

    def rays_on_body(self, rays: RangeRays) -> RayFan:
        """Return rays of a link as a fan on its body; its model has one from then on."""
        link, origins, directions = rays.link, rays.origins, rays.directions
        model = self._run.owner(link)
        each = self._run.model(model)
        own = self._run.own(model, None)[0]
        if not each.tree.links[link].fixed and np.ptp(own, axis=0).any():
            raise EngineError(
                f"'{link}' hangs on joints that differ between worlds; rays cannot start there",
                hint="use the engine mujoco",
            )
        at, turned = each.tree.place(link, own[:1])
        tilt = np.asarray(each.tilt.quaternion)
        turned = multiply(tilt[None], turned)
        start = rotate(tilt, at)[0] + rotate(turned, origins)
        along = rotate(turned, directions)
        check_level(start, along)  # before the world is changed for them
        if model not in self._run.layout.bodies:
            self._make_kinematic(model)  # a sensor needs a body to sit on
        body = self._run.layout.bodies[model]
        self._run.cut_at(float(self._run.fleet.rows[body, c.Z] + start[0, 2]))
        grid = self._run.fleet.scene.grid
        extent = self._run.fleet.rows[:, :2]
        low, high = grid[:2], grid[:2] + grid[2] * grid[3:]
        span = np.maximum(high, extent.max(axis=0)) - np.minimum(low, extent.min(axis=0))
        farthest = 2.0 * float(np.hypot(*span)) + 10.0
        return fan_of(body, start, along, min(rays.reach, farthest))


class PlanarRanges:
    """Range finders of one kind; see ``gazelle.engines.range_rays.RangeTable``.

    Args:
        casting: Casts rays.
        run: Worlds that run.
        rays: Rays of each range finder.
    """

    def __init__(self, casting: PlanarRays, run: PlanarState, rays: Sequence[RangeRays]) -> None:
        self._casting, self._run, self._rays = casting, run, tuple(rays)
        self._kept: list[CachedCaster] = []
        self._begin = 0.0
        self.system: System | None = None
        self.ranges: Floats = np.zeros((0, 0))
        if casting.range_kind(rays[0]) is not None:
            fans = [casting.rays_on_body(each) for each in rays]
            mounts = [mount for each in fans for mount in each.mounts]
            scanner = Scanner(run.fleet, fans[0].fan, mounts, missing=math.inf, signed=True)
            self.system, self.ranges = scanner.system, scanner.flat_ranges
            self._begin = fans[0].begin

    @property
    def begin(self) -> float:
        """Distance from where distances are measured to the rays' origins [m]."""
        return self._begin if self.system is not None else self._casters()[0].caster.begin

    def cast(self, worlds: Worlds | None = None) -> Floats:
        """Return distances now [m], shape (n, finders, rays)."""
        found = [kept.caster.ranges(worlds) for kept in self._casters()]
        return found[0][:, None] if len(found) == 1 else np.stack(found, axis=1)

    def _casters(self) -> list[CachedCaster]:
        """Return what casts the rays of each, as long as nothing turns their links."""
        angles = self._run.angles
        if not self._kept or not all(kept.holds(angles) for kept in self._kept):
            self._kept = [self._casting.keep(each) for each in self._rays]
        return self._kept
