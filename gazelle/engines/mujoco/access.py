"""Read and write the state of a compiled batch, by name."""

from __future__ import annotations

import functools
from abc import ABC, abstractmethod
from collections.abc import Callable
from contextlib import AbstractContextManager

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import ArrayLike, NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Pose
from gazelle.engines.motion import Hits, Motion, Placement
from gazelle.engines.mujoco.compiler import CompilerInput
from gazelle.engines.mujoco.layout import LinkSlot, ModelSlot, MujocoLayout
from gazelle.engines.mujoco.order import (
    joint_from_mujoco,
    joint_to_mujoco,
    wxyz_from_xyzw,
    xyzw_from_wxyz,
)
from gazelle.engines.mujoco.rays import behind, nearest
from gazelle.engines.mujoco.views import StateViews
from gazelle.engines.range_rays import RangeRays
from gazelle.errors import EngineError
from gazelle.rotations import conjugate, cross, from_yaw, multiply, rotate, turns, yaw_of

SIDES = ("lower", "upper")
VELOCITY_STAGE = mujoco.mjtStage.mjSTAGE_VEL.value


@functools.lru_cache(maxsize=4096)
def still_placement(pose: Pose, count: int) -> Placement:
    """Where a link that never moves is, in so many worlds; read-only."""
    place = Placement(
        np.tile(np.array(pose.position), (count, 1)), np.tile(np.array(pose.quaternion), (count, 1))
    )
    place.position.flags.writeable = place.quaternion.flags.writeable = False
    return place


@functools.lru_cache(maxsize=64)
def still_motion(count: int) -> Motion:
    """How a link moves that does not, in so many worlds; read-only."""
    zeros = np.zeros((count, 3))
    zeros.flags.writeable = False
    return Motion(zeros, zeros)


class StateAccess(ABC):
    """The part of ``gazelle.engines.engine.Engine`` that reads and writes states."""

    _batch: Batch
    _layout: MujocoLayout
    _state: StateViews
    _nworld: int
    _recipe: CompilerInput
    _pending: CompilerInput | None
    """What is to be compiled before the next step: motors, and models that become kinematic."""
    _stale: bool
    """Whether the placement of links that are not roots has to be computed."""
    _placed: bool
    """Whether something was put elsewhere since the last step."""
    _dropped: dict[int, NDArray[np.bool_]]
    """MuJoCo's loose bodies that were put elsewhere since the last step, and in which worlds."""

    @property
    @abstractmethod
    def time_step(self) -> float:
        """Physics step [s]."""

    @abstractmethod
    def parameter(self, kind: str, name: str, worlds: Worlds | None = None) -> Floats:
        """A physical parameter, shape (n, width)."""

    @abstractmethod
    def make_kinematic(self, model: str) -> None:
        """Let a model move only when told to."""

    @abstractmethod
    def _now(self) -> MujocoLayout:
        """The layout of what runs, once pending changes have been made."""

    @abstractmethod
    def _forced(self) -> AbstractContextManager[None]:
        """Let the forces of this moment act while it lasts."""

    def _known(self) -> MujocoLayout:
        """The layout to read states by, which motors that wait for the next step do not change."""
        pending = self._pending
        if pending is None or pending.kinematic == self._recipe.kinematic:
            return self._layout
        return self._now()

    # -- links -------------------------------------------------------------------------

    def link_placement(self, link: str, worlds: Worlds | None = None) -> Placement:
        """Where a link is."""
        slot = self._known().link(link)
        rows = rows_of(worlds)
        if slot.free is not None:
            q = self._state.qpos[rows, slot.free.position]
            return Placement(q[:, :3].copy(), xyzw_from_wxyz(q[:, 3:]))
        if slot.mocap is not None:
            position = self._state.mocap_pos[rows, slot.mocap].copy()
            q = self._state.mocap_quat[rows, slot.mocap]
            return Placement(position, xyzw_from_wxyz(q))
        if slot.root == "static":
            return still_placement(slot.pose, self._nworld if worlds is None else len(worlds))
        self._refresh()
        position = self._batch.xpos[rows, slot.body].copy()
        return Placement(position, xyzw_from_wxyz(self._batch.xquat[rows, slot.body]))

    def link_motion(self, link: str, worlds: Worlds | None = None) -> Motion:
        """How a link moves."""
        slot = self._known().link(link)
        rows = rows_of(worlds)
        if slot.free is not None:
            v = self._state.qvel[rows, slot.free.velocity]
            q = self._state.qpos[rows, slot.free.position][:, 3:]
            return Motion(v[:, :3].copy(), rotate(xyzw_from_wxyz(q), v[:, 3:]))
        if slot.root is not None:
            return still_motion(self._nworld if worlds is None else len(worlds))
        self._refresh()
        # MuJoCo's cvel is about the centre of mass of the whole tree.
        spatial = self._batch.cvel[rows, slot.body]
        root = int(self._batch.model.body_rootid[slot.body])
        arm = self._batch.xpos[rows, slot.body] - self._batch.subtree_com[rows, root]
        angular = spatial[:, :3].copy()
        return Motion(spatial[:, 3:] + cross(angular, arm), angular)

    def link_acceleration(self, link: str, worlds: Worlds | None = None) -> Motion:
        """How a link's motion changes in the next physics step [m/s², rad/s²]."""
        return self._change_in_step(lambda: self.link_motion(link, worlds), worlds)

    def _change_in_step(self, motion: Callable[[], Motion], worlds: Worlds | None) -> Motion:
        """How a motion changes in the next physics step of some worlds; nothing moves."""
        before = motion()
        state, warnings = self._batch.state.copy(), self._batch.warning.copy()
        with self._forced():
            self._batch.step(ids=worlds)
        self._stale = True
        after = motion()
        self._batch.state[:], self._batch.warning[:] = state, warnings
        self._stale = True
        rate = 1.0 / self.time_step
        return Motion(
            (after.linear - before.linear) * rate, (after.angular - before.angular) * rate
        )

    # -- models ------------------------------------------------------------------------

    def model_placement(self, model: str, worlds: Worlds | None = None) -> Placement:
        """Where a model's frame is: it moves with the canonical link."""
        slot = self._known().model(model)
        link = self.link_placement(slot.canonical, worlds)
        if slot.back is None:
            return link
        offset = np.asarray(slot.offset.position), np.asarray(slot.offset.quaternion)
        position = link.position + rotate(link.quaternion, offset[0])
        return Placement(position, multiply(link.quaternion, offset[1]))

    def planar_pose(self, model: str, worlds: Worlds | None = None) -> Floats:
        """Where a model's frame is, seen from above: x, y [m] and heading [rad], shape (n, 3)."""
        place = self.model_placement(model, worlds)
        return np.column_stack((place.position[:, :2], yaw_of(place.quaternion)))

    def set_model_placement(
        self, model: str, position: ArrayLike, quaternion: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Move a model rigidly, joints as they are; a static model becomes kinematic for it."""
        slot = self._now().model(model)
        if not slot.loose:
            slot = self._loosen(model, slot)
        goal_p, goal_q = np.asarray(position, np.float64), np.asarray(quaternion, np.float64)
        if len(slot.roots) == 1:
            self._put_only(slot, goal_p, goal_q, worlds)
        else:
            self._put_all(model, slot, goal_p, unit(goal_q), worlds)
        self._stale = True

    def _loosen(self, model: str, slot: ModelSlot) -> ModelSlot:
        """Make a static model one that can be placed.

        Raises:
            EngineError: A joint holds the model to the world.
        """
        if any(self._layout.link(root).root == "static" for root in slot.roots):
            self.make_kinematic(model)
            slot = self._now().model(model)
        fixed = [root for root in slot.roots if self._layout.link(root).root is None]
        if fixed:
            raise EngineError(
                f"model '{model}' is fixed to the world by a joint and cannot be moved",
                hint=f"the joint that holds '{fixed[0]}' would have to go",
            )
        return slot

    def _put_only(
        self, slot: ModelSlot, position: Floats, quaternion: Floats, worlds: Worlds | None
    ) -> None:
        """Place a model that one link carries: no need to know where it was."""
        if slot.back is not None:
            quaternion = unit(quaternion)
            position = position + rotate(quaternion, np.asarray(slot.back.position))
            quaternion = multiply(quaternion, np.asarray(slot.back.quaternion))
        self._put(self._layout.link(slot.roots[0]), position, quaternion, worlds)

    def _put_all(
        self,
        model: str,
        slot: ModelSlot,
        goal_p: Floats,
        goal_q: Floats,
        worlds: Worlds | None,
    ) -> None:
        """Place a model that several links carry, keeping them as they are to each other."""
        before = self.model_placement(model, worlds)
        turn = multiply(goal_q, conjugate(before.quaternion))
        for root in slot.roots:
            link = self.link_placement(root, worlds)
            moved = goal_p + rotate(turn, link.position - before.position)
            self._put(self._layout.link(root), moved, multiply(turn, link.quaternion), worlds)

    def _put(
        self, slot: LinkSlot, position: Floats, quaternion: Floats, worlds: Worlds | None
    ) -> None:
        rows = rows_of(worlds)
        self._placed = True
        # Normalised, or rounding errors would grow with every relative move.
        wxyz = wxyz_from_xyzw(unit(quaternion))
        if slot.mocap is not None:
            self._state.mocap_pos[rows, slot.mocap] = position
            self._state.mocap_quat[rows, slot.mocap] = wxyz
        elif slot.free is not None:
            self._dropped.setdefault(slot.body, np.zeros(self._nworld, np.bool_))[rows] = True
            start = slot.free.position.start
            self._state.qpos[rows, start : start + 3] = position
            self._state.qpos[rows, start + 3 : start + 7] = wxyz

    def set_model_motion(
        self, model: str, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give all links of a model the velocity of one rigid body, joints at rest."""
        slot = self._now().model(model)
        rows = rows_of(worlds)
        origin = self.model_placement(model, worlds)
        v = np.broadcast_to(np.asarray(linear, np.float64), origin.position.shape)
        w = np.broadcast_to(np.asarray(angular, np.float64), origin.position.shape)
        for root in slot.roots:
            free = self._layout.link(root).free
            if free is None:
                continue
            link = self.link_placement(root, worlds)
            at_link = v + cross(w, link.position - origin.position)
            local = rotate(conjugate(link.quaternion), w)
            self._state.qvel[rows, free.velocity] = np.concatenate((at_link, local), axis=1)
        for joint in slot.joints:
            for each in self._layout.joint(joint):
                self._state.qvel[rows, each.velocity] = 0.0
        self._stale = True

    def set_ground_motion(self, model: str, twist: ArrayLike, worlds: Worlds | None = None) -> None:
        """Give all links of a model a level velocity along and across its heading."""
        heading = from_yaw(yaw_of(self.model_placement(model, worlds).quaternion))
        wanted = np.atleast_2d(np.asarray(twist, np.float64))
        level, spin = wanted * (1.0, 1.0, 0.0), wanted * (0.0, 0.0, 1.0)
        self.set_model_motion(model, rotate(heading, level), spin, worlds)

    # -- joints ------------------------------------------------------------------------

    def joint_position(self, joint: str, worlds: Worlds | None = None) -> Floats:
        """Position [m or rad], shape (n, axes)."""
        slots = self._known().joint(joint)
        return joint_from_mujoco(_read(self._state.qpos, [s.position for s in slots], worlds))

    def joint_velocity(self, joint: str, worlds: Worlds | None = None) -> Floats:
        """Velocity [m/s or rad/s], shape (n, axes)."""
        slots = self._known().joint(joint)
        return _read(self._state.qvel, [s.velocity for s in slots], worlds)

    def set_joint_position(
        self, joint: str, position: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Put a joint somewhere [m or rad], shape (axes,) or (n, axes), to its limits at most."""
        self._placed = True
        slots = self._now().joint(joint)
        given = joint_to_mujoco(np.atleast_1d(np.asarray(position, np.float64)))
        if len(slots) > 1 or slots[0].position.stop - slots[0].position.start == 1:
            lower, upper = (self.parameter(f"joint_{side}", joint, worlds) for side in SIDES)
            given = np.clip(given, lower, np.maximum(lower, upper))
        self._write(self._state.qpos, [s.position for s in slots], given, worlds)

    def set_joint_velocity(
        self, joint: str, velocity: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give a joint a velocity [m/s or rad/s], shape (axes,) or (n, axes)."""
        slots = self._now().joint(joint)
        self._write(self._state.qvel, [s.velocity for s in slots], velocity, worlds)

    def set_joint_effort(self, joint: str, effort: ArrayLike, worlds: Worlds | None = None) -> None:
        """Apply an effort [N or N m] until told otherwise, shape (axes,) or (n, axes)."""
        slots = self._now().joint(joint)
        given = np.atleast_1d(np.asarray(effort, np.float64))
        within = self._layout.limits.clamp(joint, given)
        self._write(self._state.qfrc_applied, [s.velocity for s in slots], within, worlds)

    def _write(
        self, array: Floats, columns: list[slice], values: ArrayLike, worlds: Worlds | None
    ) -> None:
        given = np.atleast_1d(np.asarray(values, np.float64))
        start = 0
        for column in columns:
            width = column.stop - column.start
            array[rows_of(worlds), column] = given[..., start : start + width]
            start += width
        self._stale = True

    # -- motors ------------------------------------------------------------------------

    def set_motor_velocity(
        self, joint: str, velocity: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set the velocity that a joint's motor holds; see the protocol."""
        columns = self._now().motor(joint).targets
        given = np.asarray(velocity, np.float64)
        if columns.stop - columns.start == 1 and given.ndim == 1:
            given = given[:, None]
        self._state.userdata[rows_of(worlds), columns] = given

    # -- sensing -----------------------------------------------------------------------

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
        place = self.link_placement(link, worlds)
        turn = turns(place.quaternion)
        start, along = place.position[:, None, :] + origins @ turn, directions @ turn
        body = self._layout.link(link).body if ignore_own else 0
        if ignore_own and not body:
            inside = f"{link}::"
            own = [
                geom
                for name, geoms in self._layout.collisions.items()
                if name.startswith(inside)
                for geom in geoms
            ]
            return behind(self._batch, start, along, worlds, own)
        return nearest(self._batch, start, along, worlds, body)[0]

    def cast_ranges(self, rays: RangeRays, worlds: Worlds | None = None) -> tuple[Floats, float]:
        """Follow rays of a range finder; see the protocol."""
        hits = self.cast_rays(rays.link, rays.origins, rays.directions, worlds)
        return np.where(hits.from_inside, -np.inf, hits.distance), 0.0

    def _refresh(self) -> None:
        """Compute the placement and motion of links that are not roots."""
        if self._stale:
            self._batch.forward(stage=VELOCITY_STAGE)
            self._stale = False


def rows_of(worlds: Worlds | None) -> slice | Worlds:
    """An index for these worlds, all if None."""
    return slice(None) if worlds is None else worlds


def _read(array: Floats, columns: list[slice], worlds: Worlds | None) -> Floats:
    """A copy of some columns, side by side."""
    rows = rows_of(worlds)
    if len(columns) == 1:
        return array[rows, columns[0]].copy()
    return np.concatenate([array[rows, each] for each in columns], axis=1)


def unit(q: Floats) -> Floats:
    """Quaternions normalised; zero becomes the identity, as in Gazebo."""
    norm: Floats = np.sqrt(np.einsum("...i,...i->...", q, q))[..., None]
    if norm.all():
        return q / norm
    whole = np.where(norm > 0.0, q, (0.0, 0.0, 0.0, 1.0))
    return whole / np.where(norm > 0.0, norm, 1.0)
