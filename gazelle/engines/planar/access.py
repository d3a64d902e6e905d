"""Read and write the state of a planar world, by name."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Pose
from gazelle.engines.motion import Hits, Motion, Placement
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.anatomy import Anatomy
from gazelle.engines.planar.build import PlanarLayout
from gazelle.engines.planar.fans import Scanner
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.link_table import PlanarLinkTable
from gazelle.engines.planar.model_table import PlanarModelTable
from gazelle.engines.planar.rays import Caster, KeptCaster, RayFan, caster_of, fan_of
from gazelle.engines.range_rays import RangeRays
from gazelle.engines.system_engine import CastRanges
from gazelle.errors import EngineError, did_you_mean
from gazelle.rotations import conjugate, cross, from_yaw, multiply, rotate, yaw_of

T = TypeVar("T")

_MOST = 256  # arrays of rays that are known by where they are, and sets of models


class PlanarAccess(ABC):
    """The part of ``gazelle.engines.engine.Engine`` that reads and writes states."""

    _fleet: Fleet
    _layout: PlanarLayout
    _angles: Floats
    _rates: Floats
    _targets: Floats
    _casters: dict[tuple[str, bytes, bytes, float], KeptCaster]
    _recent: dict[tuple[str, int, int, float], KeptCaster]
    _tables: dict[tuple[str, ...], PlanarLinkTable]
    _model_tables: dict[tuple[str, ...], PlanarModelTable]

    @abstractmethod
    def make_kinematic(self, model: str) -> None:
        """Let a model move only when told to."""

    @abstractmethod
    def motor_targets(self, joint: str) -> tuple[Floats, int]:
        """Velocities that motors hold, and a joint's column."""

    @abstractmethod
    def _cut_at(self, height: float) -> None:
        """Cut shapes at one more height [m], for rays."""

    # -- models ------------------------------------------------------------------------

    def model_placement(self, model: str, worlds: Worlds | None = None) -> Placement:
        """Where a model's frame is."""
        each = self._model(model)
        body = self._layout.bodies.get(model)
        if body is None:
            count = self._fleet.nworld if worlds is None else len(worlds)
            pose = each.model.pose
            return Placement(
                np.tile(pose.position, (count, 1)), np.tile(pose.quaternion, (count, 1))
            )
        rows = self._fleet.rows[self._rows(body, worlds)]
        turned = multiply(from_yaw(rows[:, c.YAW]), np.asarray(each.tilt.quaternion)[None])
        return Placement(rows[:, [c.X, c.Y, c.Z]], turned)

    def planar_pose(self, model: str, worlds: Worlds | None = None) -> Floats:
        """Where a model's frame is, seen from above: x, y [m] and heading [rad], shape (n, 3)."""
        each, body = self._model(model), self._layout.bodies.get(model)
        count = self._fleet.nworld if worlds is None else len(worlds)
        if body is None:
            pose = each.model.pose
            return np.tile((pose.x, pose.y, pose.yaw), (count, 1))
        found: Floats = self._fleet.rows[self._rows(body, worlds), : c.COS].copy()
        if each.leaning:
            found[:, c.YAW] = yaw_of(self.model_placement(model, worlds).quaternion)
        return found

    def set_model_placement(
        self, model: str, position: ArrayLike, quaternion: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Put a model somewhere in the plane; a static model becomes kinematic for it.

        It keeps the way it leans; a robot on wheels stays on the ground.
        """
        each = self._model(model)
        if each.skeleton.held:
            raise EngineError(
                f"model '{model}' is fixed to the world by a joint and cannot be moved",
                hint="the joint that holds it would have to go",
            )
        if each.still:
            self.make_kinematic(model)
            each = self._model(model)
        place = np.atleast_2d(np.asarray(position, np.float64))
        turned = np.atleast_2d(np.asarray(quaternion, np.float64))
        yaw = yaw_of(multiply(turned, conjugate(np.asarray(each.tilt.quaternion)[None])))
        count = max(len(place), len(yaw))
        pose = np.empty((count, 3))
        pose[:, :2], pose[:, 2] = place[:, :2], yaw
        body = self._layout.bodies[model]
        self._fleet.place(body, pose if count > 1 else pose[0], worlds)
        if not (each.loose and each.skeleton.wheels):
            self._fleet.rows[self._rows(body, worlds), c.Z] = place[:, 2]

    def set_model_motion(
        self, model: str, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give a model a velocity, which it keeps in its own frame, joints at rest."""
        each = self._model(model)
        if not each.loose:
            return
        rows = self._rows(self._layout.bodies[model], worlds)
        body = self._fleet.rows[rows]
        v, w = np.asarray(linear, np.float64), np.asarray(angular, np.float64)
        twist = np.empty((len(body), 3))
        twist[:, 0] = body[:, c.COS] * v[..., 0] + body[:, c.SIN] * v[..., 1]
        twist[:, 1] = body[:, c.COS] * v[..., 1] - body[:, c.SIN] * v[..., 0]
        twist[:, 2] = w[..., 2]
        self.set_ground_motion(model, twist, worlds)

    def set_ground_motion(self, model: str, twist: ArrayLike, worlds: Worlds | None = None) -> None:
        """Give a model a velocity along and across its heading, which it keeps, joints at rest."""
        each = self._model(model)
        if not each.loose:
            return
        rows = self._rows(self._layout.bodies[model], worlds)
        self._fleet.command.reshape(-1, 3)[rows] = twist
        self._fleet.velocity.reshape(-1, 3)[rows] = twist
        self._fleet.stalled.reshape(-1)[rows] = False
        first = self._layout.columns[model]
        self._rates[rows_of(worlds), first : first + each.skeleton.width] = 0.0

    def model_table(self, models: Sequence[str]) -> PlanarModelTable:
        """Models looked up once, to be read or moved together; good for one ``revision``."""
        key = tuple(models)
        table = self._model_tables.get(key)
        if table is None:
            if len(self._model_tables) >= _MOST:
                self._model_tables.clear()
            table = PlanarModelTable(self._layout, key, self._fleet, self._rates)
            self._model_tables[key] = table
        return table

    # -- links -------------------------------------------------------------------------

    def link_placement(self, link: str, worlds: Worlds | None = None) -> Placement:
        """Where a link is."""
        model = self._owner(link)
        base = self.model_placement(model, worlds)
        position, turned = self._model(model).skeleton.place(link, self._own(model, worlds)[0])
        return Placement(
            base.position + rotate(base.quaternion, position), multiply(base.quaternion, turned)
        )

    def link_placements(self, links: Sequence[str], worlds: Worlds | None = None) -> Placement:
        """Where many links are at once: shapes (n, links, 3) and (n, links, 4)."""
        key = tuple(links)
        table = self._tables.get(key)
        if table is None or table.layout is not self._layout:
            table = self._tables[key] = PlanarLinkTable(self._layout, key)
        return table.placement(self._fleet, self._angles, worlds)

    def link_motion(self, link: str, worlds: Worlds | None = None) -> Motion:
        """How a link moves."""
        model = self._owner(link)
        base = self.model_placement(model, worlds)
        skeleton = self._model(model).skeleton
        angles, rates = self._own(model, worlds)
        inner = skeleton.motion(link, angles, rates)
        arm = rotate(base.quaternion, skeleton.place(link, angles)[0])
        linear, spin = self._twist(model, worlds)
        linear = linear + cross(spin, arm) + rotate(base.quaternion, inner[0])
        return Motion(linear, spin + rotate(base.quaternion, inner[1]))

    def link_acceleration(self, link: str, worlds: Worlds | None = None) -> Motion:
        """How a link's motion changes: only towards the middle of the arc it is on."""
        motion = self.link_motion(link, worlds)
        spin = self._twist(self._owner(link), worlds)[1]
        return Motion(cross(spin, motion.linear), np.zeros_like(spin))

    def set_link_placement(
        self, link: str, position: ArrayLike, quaternion: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Move a link's model so that the link is there, joints as they are."""
        model = self._owner(link)
        at, turned = self._model(model).skeleton.place(link, self._own(model, worlds)[0])
        frame = multiply(np.asarray(quaternion, np.float64), conjugate(turned))
        origin = np.asarray(position, np.float64) - rotate(frame, at)
        self.set_model_placement(model, origin, frame, worlds)

    def set_link_motion(
        self, link: str, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give a link's model the velocity with which the link moves so, joints at rest."""
        model = self._owner(link)
        arm = self.link_placement(link, worlds).position
        arm = arm - self.model_placement(model, worlds).position
        spin = np.broadcast_to(np.asarray(angular, np.float64), arm.shape)
        origin = np.asarray(linear, np.float64) - cross(spin, arm)
        self.set_model_motion(model, origin, spin, worlds)

    def link_centre(self, link: str, worlds: Worlds | None = None) -> Floats:
        """Where a link's centre of mass is [m], in the world frame, shape (n, 3)."""
        place = self.link_placement(link, worlds)
        inertial = self._model(self._owner(link)).skeleton.bones[link].link.inertial
        offset = Pose() if inertial is None else inertial.pose
        return place.position + rotate(place.quaternion, np.asarray(offset.position)[None])

    # -- joints ------------------------------------------------------------------------

    def joint_position(self, joint: str, worlds: Worlds | None = None) -> Floats:
        """Position [m or rad], shape (n, axes)."""
        return self._angles[rows_of(worlds), self._axes(joint)].copy()

    def joint_velocity(self, joint: str, worlds: Worlds | None = None) -> Floats:
        """Velocity [m/s or rad/s], shape (n, axes)."""
        return self._rates[rows_of(worlds), self._axes(joint)].copy()

    def set_joint_position(
        self, joint: str, position: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Put a joint somewhere [m or rad], shape (axes,) or (n, axes)."""
        self._angles[rows_of(worlds), self._axes(joint)] = position

    def set_joint_velocity(
        self, joint: str, velocity: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give a joint a velocity, which it keeps [m/s or rad/s], shape (axes,) or (n, axes)."""
        self._rates[rows_of(worlds), self._axes(joint)] = velocity

    def joint_effort(self, joint: str, worlds: Worlds | None = None) -> Floats:
        """Nothing: efforts do not act here; zeros, shape (n, axes)."""
        return np.zeros_like(self.joint_position(joint, worlds))

    def set_motor_velocity(
        self, joint: str, velocity: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set the velocity that a joint's motor holds [m/s or rad/s], shape () or (n,)."""
        targets, column = self.motor_targets(joint)
        targets[rows_of(worlds), column] = velocity

    # -- sensing -----------------------------------------------------------------------

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
        if kept is None or not kept.holds(self._angles):
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
        if kept is not None and kept.holds(self._angles):
            return kept if kept.of is origins else replace(kept, of=origins, along=directions)
        caster = caster_of(self._fleet, self._rays_on_body(rays))
        model = self._owner(link)
        columns = self._layout.columns[model] + self._model(model).skeleton.columns_of(link)
        angles = self._angles[:, columns].copy() if len(columns) else self._angles[:0]
        kept = self._casters[key] = KeptCaster(caster, columns, angles, origins, directions)
        return kept

    def ranges_kind(self, rays: RangeRays) -> Hashable | None:
        """Equal for rays that are cast together; see ``SystemEngine``."""
        try:
            found = self._rays_on_body(rays)
        except EngineError:
            return None
        skeleton = self._model(self._owner(rays.link)).skeleton
        if len(found.mounts) > 1 or len(skeleton.columns_of(rays.link)):
            return None
        return found.fan, found.begin

    def ranges_of(self, rays: Sequence[RangeRays]) -> CastRanges:
        """What casts rays of one kind together; see ``SystemEngine``."""
        fans = [self._rays_on_body(each) for each in rays]
        scanner = Scanner(
            self._fleet,
            fans[0].fan,
            [mount for each in fans for mount in each.mounts],
            missing=math.inf,
            signed=True,
        )
        return CastRanges(scanner.system, scanner.flat_ranges, fans[0].begin)

    def _rays_on_body(self, rays: RangeRays) -> RayFan:
        """Rays of a link as a fan on its body; its model has one from then on."""
        link, origins, directions = rays.link, rays.origins, rays.directions
        model = self._owner(link)
        each = self._model(model)
        if model not in self._layout.bodies:
            self.make_kinematic(model)  # a sensor needs a body to sit on
            each = self._model(model)
        own = self._own(model, None)[0]
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
        body = self._layout.bodies[model]
        self._cut_at(float(self._fleet.rows[body, c.Z] + start[0, 2]))
        grid = self._fleet.scene.grid
        extent = self._fleet.rows[:, :2]
        low, high = grid[:2], grid[:2] + grid[2] * grid[3:]
        span = np.maximum(high, extent.max(axis=0)) - np.minimum(low, extent.min(axis=0))
        farthest = 2.0 * float(np.hypot(*span)) + 10.0
        return fan_of(body, start, along, min(rays.reach, farthest))

    # -- finding -----------------------------------------------------------------------

    def _twist(self, model: str, worlds: Worlds | None) -> tuple[Floats, Floats]:
        """Velocity of a model's frame in the world: linear and angular, shapes (n, 3)."""
        count = self._fleet.nworld if worlds is None else len(worlds)
        linear, spin = np.zeros((count, 3)), np.zeros((count, 3))
        if not self._model(model).loose:
            return linear, spin
        rows = self._rows(self._layout.bodies[model], worlds)
        body, v = self._fleet.rows[rows], self._fleet.velocity.reshape(-1, 3)[rows]
        v = np.where(self._fleet.stalled.reshape(-1)[rows][:, None], 0.0, v)
        linear[:, 0] = body[:, c.COS] * v[:, 0] - body[:, c.SIN] * v[:, 1]
        linear[:, 1] = body[:, c.SIN] * v[:, 0] + body[:, c.COS] * v[:, 1]
        spin[:, 2] = v[:, 2]
        return linear, spin

    def _own(self, model: str, worlds: Worlds | None) -> tuple[Floats, Floats]:
        """Positions and velocities of a model's joints, shapes (n, axes)."""
        first = self._layout.columns[model]
        columns = slice(first, first + self._layout.models[model].skeleton.width)
        rows = rows_of(worlds)
        return self._angles[rows, columns], self._rates[rows, columns]

    def _model(self, name: str) -> Anatomy:
        return _look_up("model", name, self._layout.models)

    def _owner(self, link: str) -> str:
        return _look_up("link", link, self._layout.owners)

    def _axes(self, joint: str) -> slice:
        first, count = _look_up("joint", joint, self._layout.joints)
        return slice(first, first + count)

    def _rows(self, body: int, worlds: Worlds | None) -> slice | NDArray[np.intp]:
        """Rows of a body in the fleet's tables."""
        nbody = self._fleet.nbody
        return slice(body, None, nbody) if worlds is None else worlds * nbody + body


def rows_of(worlds: Worlds | None) -> slice | Worlds:
    """An index for these worlds, all if None."""
    return slice(None) if worlds is None else worlds


def _look_up(kind: str, name: str, known: Mapping[str, T]) -> T:
    try:
        return known[name]
    except KeyError:
        raise EngineError(f"there is no {kind} '{name}'", hint=did_you_mean(name, known)) from None
