"""Follow the rays of sensors through a planar world."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Sequence
from dataclasses import replace

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.engines.motion import Hits
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.fans import Scanner
from gazelle.engines.planar.rays import Caster, KeptCaster, RayFan, caster_of, fan_of
from gazelle.engines.planar.running import RunningPlane
from gazelle.engines.range_rays import RangeRays
from gazelle.engines.system_engine import CastRanges
from gazelle.errors import EngineError
from gazelle.rotations import multiply, rotate

_MOST = 256  # arrays of rays that are known by where they are


class PlanarRays:
    """The part of ``gazelle.engines.engine.Engine`` that casts rays.

    Args:
        run: What runs.
        make_kinematic: The engine's; a sensor needs a body to sit on.
    """

    def __init__(self, run: RunningPlane, make_kinematic: Callable[[str], None]) -> None:
        self._run, self._make_kinematic = run, make_kinematic
        self._casters: dict[tuple[str, bytes, bytes, float], KeptCaster] = {}
        self._recent: dict[tuple[str, int, int, float], KeptCaster] = {}
        run.on_change.append(self._forget)

    def _forget(self) -> None:
        self._casters, self._recent = {}, {}

    def cast_rays(
        self,
        link: str,
        origins: Floats,
        directions: Floats,
        worlds: Worlds | None = None,
        *,
        ignore_own: bool = False,  # noqa: ARG002  rays never meet their own model
    ) -> Hits:
        """Follow level rays to the nearest collision shape of another model."""
        distance, inside = self.caster(link, origins, directions).cast(worlds)
        return Hits(distance, inside)

    def cast_ranges(self, rays: RangeRays, worlds: Worlds | None = None) -> tuple[Floats, float]:
        """Follow the level rays of a range finder; see the protocol."""
        key = (rays.link, id(rays.origins), id(rays.directions), rays.reach)
        kept = self._recent.get(key)
        if kept is None or not kept.holds(self._run.angles):
            kept = self._keep(rays)
            self._recent = {**self._recent, key: kept} if len(self._recent) < _MOST else {key: kept}
        return kept.caster.ranges(worlds), kept.caster.begin

    def caster(self, link: str, origins: Floats, directions: Floats) -> Caster:
        """What casts the rays of ``cast_rays``: the same one as long as nothing turns its link.

        Raises:
            EngineError: The rays are not level, or their link not the same in all worlds.
        """
        return self._keep(RangeRays(link, origins, directions)).caster

    def _keep(self, rays: RangeRays) -> KeptCaster:
        """A caster that is kept, or one that is from now on."""
        link, origins, directions = rays.link, rays.origins, rays.directions
        key = (link, origins.tobytes(), directions.tobytes(), rays.reach)
        kept = self._casters.get(key)
        if kept is not None and kept.holds(self._run.angles):
            return kept if kept.of is origins else replace(kept, of=origins, along=directions)
        caster = caster_of(self._run.fleet, self._rays_on_body(rays))
        model = self._run.owner(link)
        columns = self._run.layout.columns[model] + self._run.model(model).skeleton.columns_of(link)
        angles = self._run.angles[:, columns].copy() if len(columns) else self._run.angles[:0]
        kept = self._casters[key] = KeptCaster(caster, columns, angles, origins, directions)
        return kept

    def ranges_kind(self, rays: RangeRays) -> Hashable | None:
        """Equal for rays that are cast together; see ``SystemEngine``."""
        try:
            found = self._rays_on_body(rays)
        except EngineError:
            return None
        skeleton = self._run.model(self._run.owner(rays.link)).skeleton
        if len(found.mounts) > 1 or len(skeleton.columns_of(rays.link)):
            return None
        return found.fan, found.begin

    def ranges_of(self, rays: Sequence[RangeRays]) -> CastRanges:
        """What casts rays of one kind together; see ``SystemEngine``."""
        fans = [self._rays_on_body(each) for each in rays]
        scanner = Scanner(
            self._run.fleet,
            fans[0].fan,
            [mount for each in fans for mount in each.mounts],
            missing=math.inf,
            signed=True,
        )
        return CastRanges(scanner.system, scanner.flat_ranges, fans[0].begin)

    def _rays_on_body(self, rays: RangeRays) -> RayFan:
        """Rays of a link as a fan on its body; its model has one from then on."""
        link, origins, directions = rays.link, rays.origins, rays.directions
        model = self._run.owner(link)
        each = self._run.model(model)
        if model not in self._run.layout.bodies:
            self._make_kinematic(model)  # a sensor needs a body to sit on
            each = self._run.model(model)
        own = self._run.own(model, None)[0]
        bone = each.skeleton.bones[link]
        if not bone.fixed and np.ptp(own, axis=0).any():
            raise EngineError(
                f"'{link}' hangs on joints that differ between worlds; rays cannot start there",
                hint="use the engine mujoco",
            )
        at, turned = each.skeleton.place(link, own[:1])
        tilt = np.asarray(each.tilt.quaternion)
        turned = multiply(tilt[None], turned)
        start = rotate(tilt, at)[0] + rotate(turned, origins)
        along = rotate(turned, directions)
        body = self._run.layout.bodies[model]
        self._run.cut_at(float(self._run.fleet.rows[body, c.Z] + start[0, 2]))
        grid = self._run.fleet.scene.grid
        extent = self._run.fleet.rows[:, :2]
        low, high = grid[:2], grid[:2] + grid[2] * grid[3:]
        span = np.maximum(high, extent.max(axis=0)) - np.minimum(low, extent.min(axis=0))
        farthest = 2.0 * float(np.hypot(*span)) + 10.0
        return fan_of(body, start, along, min(rays.reach, farthest))
