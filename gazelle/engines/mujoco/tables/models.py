"""Rows of models in MuJoCo's arrays."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Indices, Worlds
from gazelle.description import Pose
from gazelle.engines.motion import Placement
from gazelle.engines.mujoco.layout import ModelSlot, MujocoLayout
from gazelle.engines.mujoco.quaternions import xyzw_from_wxyz
from gazelle.engines.mujoco.state import rows_of
from gazelle.engines.mujoco.tables.planar_velocity import LevelMotion
from gazelle.engines.mujoco.tables.root_poses import put_root
from gazelle.engines.mujoco.worlds import RunningWorlds
from gazelle.engines.state import LinkRow, LinkRows
from gazelle.engines.table import Lookup, Table
from gazelle.errors import EngineError
from gazelle.native.paths import ModelPath, PosePath
from gazelle.native.system import System
from gazelle.rotations import conjugate, cross, from_yaw, multiply, rotate, unit, yaw_of


class MujocoModelRow:
    """One model; see ``gazelle.engines.state.ModelRow``.

    Args:
        run: Worlds that run.
        name: Name of the model.
        links: Links of all models.
        make_kinematic: The engine's.
    """

    def __init__(
        self,
        run: RunningWorlds,
        name: str,
        links: Table[LinkRow, LinkRows],
        make_kinematic: Callable[[str], None],
    ) -> None:
        self._run, self._name, self._links = run, name, links
        self._make_kinematic = make_kinematic
        self._freely = Lookup[MujocoLayout, int | None](lambda at: _first_column(at, name))

    def placement(self, worlds: Worlds | None = None) -> Placement:
        """Return the pose of the model's frame, which moves with the canonical link."""
        slot = self._run.known().model(self._name)
        link = self._links[slot.canonical].placement(worlds)
        if slot.back is None:
            return link
        offset = np.asarray(slot.offset.position), np.asarray(slot.offset.quaternion)
        position = link.position + rotate(link.quaternion, offset[0])
        return Placement(position, multiply(link.quaternion, offset[1]))

    def pose(self, world: int) -> Pose:
        """Return the pose of the model's frame in one world."""
        return self.placement(np.array((world,))).first()

    def planar_pose(self, worlds: Worlds | None = None) -> Floats:
        """Return the pose seen from above: x, y [m] and heading [rad], shape (n, 3)."""
        first = self._freely.within(self._run.known())
        if first is None:
            place = self.placement(worlds)
            position, yaw = place.position, yaw_of(place.quaternion)
        else:
            state = self._run.state.qpos[rows_of(worlds), first : first + 7]
            if len(state) == 1:
                return _planar_pose_of_one(state)
            position, yaw = state, yaw_of(xyzw_from_wxyz(state[:, 3:]))
        pose = np.empty((len(yaw), 3))
        pose[:, :2], pose[:, 2] = position[:, :2], yaw
        return pose

    def set_placement(
        self, position: ArrayLike, quaternion: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Move the model rigidly, joints as they are; a static model becomes kinematic for it."""
        slot = self._run.up_to_date().model(self._name)
        if not slot.free:
            slot = self._freed(slot)
        goal_p, goal_q = np.asarray(position, np.float64), np.asarray(quaternion, np.float64)
        if len(slot.roots) == 1:
            self._put_only(slot, goal_p, goal_q, worlds)
        else:
            self._put_all(slot, goal_p, unit(goal_q), worlds)
        self._run.stale = True

    def _freed(self, slot: ModelSlot) -> ModelSlot:
        """Return the slot of a static model, made placeable.

        Raises:
            EngineError: A joint holds the model to the world.
        """
        if any(self._run.layout.link(root).root == "static" for root in slot.roots):
            self._make_kinematic(self._name)
            slot = self._run.up_to_date().model(self._name)
        fixed = [root for root in slot.roots if self._run.layout.link(root).root is None]
        if fixed:
            raise EngineError(
                f"model '{self._name}' is fixed to the world by a joint and cannot be moved",
                hint=f"remove the joint that holds '{fixed[0]}'",
            )
        return slot

    def _put_only(
        self, slot: ModelSlot, position: Floats, quaternion: Floats, worlds: Worlds | None
    ) -> None:
        """Place a model with a single root, whatever its previous pose."""
        if slot.back is not None:
            quaternion = unit(quaternion)
            position = position + rotate(quaternion, np.asarray(slot.back.position))
            quaternion = multiply(quaternion, np.asarray(slot.back.quaternion))
        put_root(self._run, self._run.layout.link(slot.roots[0]), position, quaternion, worlds)

    def _put_all(
        self, slot: ModelSlot, goal_p: Floats, goal_q: Floats, worlds: Worlds | None
    ) -> None:
        """Place a model with several roots, which keep their relative poses."""
        before = self.placement(worlds)
        turn = multiply(goal_q, conjugate(before.quaternion))
        for root in slot.roots:
            link = self._links[root].placement(worlds)
            moved = goal_p + rotate(turn, link.position - before.position)
            turned = multiply(turn, link.quaternion)
            put_root(self._run, self._run.layout.link(root), moved, turned, worlds)

    def path(self, path: ModelPath) -> System | None:
        """Return what moves the model along a path; None where it has several root links."""
        slot = self._run.up_to_date().model(self._name)
        mocap = self._run.layout.link(slot.roots[0]).mocap
        if len(slot.roots) > 1 or mocap is None:
            return None
        state, back = self._run.state, slot.back or Pose()
        return PosePath(
            path,
            state.mocap_pos[:, mocap],
            state.mocap_quat[:, mocap],
            arm=np.array(back.position),
            turned=np.array(back.quaternion),
            moved=self._run.moved[:1],
        )

    def set_motion(
        self, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set the velocity of all links of the model to that of one rigid body, joints at rest."""
        slot = self._run.up_to_date().model(self._name)
        rows = rows_of(worlds)
        origin = self.placement(worlds)
        v = np.broadcast_to(np.asarray(linear, np.float64), origin.position.shape)
        w = np.broadcast_to(np.asarray(angular, np.float64), origin.position.shape)
        for root in slot.roots:
            free = self._run.layout.link(root).free
            if free is None:
                continue
            link = self._links[root].placement(worlds)
            at_link = v + cross(w, link.position - origin.position)
            local = rotate(conjugate(link.quaternion), w)
            self._run.state.qvel[rows, free.velocity] = np.concatenate((at_link, local), axis=1)
        for joint in slot.joints:
            for each in self._run.layout.joint(joint):
                self._run.state.qvel[rows, each.velocity] = 0.0
        self._run.stale = True

    def set_ground_motion(self, twist: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set a level velocity of all links of the model, along and across its heading."""
        heading = from_yaw(yaw_of(self.placement(worlds).quaternion))
        twists = np.atleast_2d(np.asarray(twist, np.float64))
        level, spin = twists * (1.0, 1.0, 0.0), twists * (0.0, 0.0, 1.0)
        self.set_motion(rotate(heading, level), spin, worlds)


def _first_column(layout: MujocoLayout, model: str) -> int | None:
    """Return the column of a model's position if its frame is that of a free body, else None."""
    slot = layout.model(model)
    free = layout.link(slot.canonical).free
    return None if free is None or slot.back is not None else free.position.start


def _planar_pose_of_one(state: Floats) -> Floats:
    """Return x, y and heading of a single free body, to the bit, shape (1, 3)."""
    x, y, _, w, i, j, k = state[0].tolist()
    yaw = np.arctan2(2.0 * (w * k + i * j), 1.0 - 2.0 * (j * j + k * k))
    return np.array(((x, y, yaw),))


@dataclass(frozen=True, slots=True)
class _Frames:
    """Frames of some models.

    Attributes:
        links: Scoped names of those with the frames.
        moved: Models whose frames are not their links', shape (k,).
        at: Positions of those in their links' frames [m], shape (k, 3).
        turned: Quaternions (x, y, z, w), shape (k, 4).
    """

    links: tuple[str, ...]
    moved: Indices
    at: Floats
    turned: Floats

    @classmethod
    def find(cls, layout: MujocoLayout, models: Sequence[str]) -> _Frames:
        """Look up models.

        Raises:
            EngineError: There is no such model.
        """
        slots = [layout.model(name) for name in models]
        moved = [i for i, slot in enumerate(slots) if slot.back is not None]
        at = [slots[i].offset.position for i in moved]
        turned = [slots[i].offset.quaternion for i in moved]
        return cls(
            tuple(slot.canonical for slot in slots),
            np.array(moved, np.intp),
            np.array(at).reshape(-1, 3),
            np.array(turned).reshape(-1, 4),
        )


@dataclass(frozen=True, slots=True)
class _Roots:
    """Free links that are roots of some models.

    Attributes:
        links: Their scoped names.
        owners: Places of their models, shape (k,).
        rates: Columns of their velocities, shape (k, 6).
        dofs: Columns of the velocities of all joints of the models, shape (joints,).
    """

    links: tuple[str, ...]
    owners: Indices
    rates: Indices
    dofs: Indices

    @classmethod
    def find(cls, layout: MujocoLayout, models: Sequence[str]) -> _Roots:
        """Look up models.

        Raises:
            EngineError: There is no such model.
        """
        slots = [layout.model(name) for name in models]
        found = [
            (root, owner, free.velocity)
            for owner, slot in enumerate(slots)
            for root in slot.roots
            if (free := layout.link(root).free) is not None
        ]
        joints = [each.velocity for s in slots for name in s.joints for each in layout.joint(name)]
        return cls(
            tuple(root for root, _, _ in found),
            np.array([owner for _, owner, _ in found], np.intp),
            np.array([range(at.start, at.stop) for _, _, at in found], np.intp).reshape(-1, 6),
            np.array([column for at in joints for column in range(at.start, at.stop)], np.intp),
        )


class MujocoModelRows:
    """Several models; see ``gazelle.engines.state.ModelRows``.

    Args:
        run: Worlds that run.
        names: Names of the models.
        links: Links of all models.
    """

    def __init__(
        self, run: RunningWorlds, names: tuple[str, ...], links: Table[LinkRow, LinkRows]
    ) -> None:
        self._run, self._names, self._links = run, names, links
        self._frames = Lookup[MujocoLayout, _Frames](lambda at: _Frames.find(at, names))
        self._roots = Lookup[MujocoLayout, _Roots](lambda at: _Roots.find(at, names))

    def placement(self, worlds: Worlds | None = None) -> Placement:
        """Return the poses of the models' frames, shapes (n, models, 3) and (n, models, 4)."""
        frames = self._frames.within(self._run.known())
        place = self._links[frames.links].placement(worlds)
        if not len(frames.moved):
            return place
        position, turned = place.position.copy(), place.quaternion.copy()
        quaternion = turned[:, frames.moved]
        position[:, frames.moved] += rotate(quaternion, frames.at[None])
        turned[:, frames.moved] = multiply(quaternion, frames.turned[None])
        return Placement(position, turned)

    def set_ground_motion(self, twist: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set level velocities of the models along and across their headings, joints at rest."""
        roots = self._roots.within(self._run.up_to_date())
        origin = self.placement(worlds)
        twists = np.broadcast_to(np.asarray(twist, np.float64), origin.position.shape)
        heading = from_yaw(yaw_of(origin.quaternion))
        v = rotate(heading, twists * (1.0, 1.0, 0.0))[:, roots.owners]
        w = (twists * (0.0, 0.0, 1.0))[:, roots.owners]
        link = self._links[roots.links].placement(worlds)
        at_link = v + cross(w, link.position - origin.position[:, roots.owners])
        local = rotate(conjugate(link.quaternion), w)
        velocity = np.concatenate((at_link, local), axis=-1)
        if worlds is None:
            self._run.state.qvel[:, roots.rates] = velocity
            self._run.state.qvel[:, roots.dofs] = 0.0
        else:
            self._run.state.qvel[worlds[:, None, None], roots.rates] = velocity
            self._run.state.qvel[worlds[:, None], roots.dofs] = 0.0
        self._run.stale = True

    def twist(self, linear: Floats, angular: Floats) -> System | None:
        """Return what gives the models their velocities; None unless each has one free root link."""
        layout, state = self._run.up_to_date(), self._run.state
        slots = [layout.model(name) for name in self._names]
        free = [layout.link(slot.canonical).free for slot in slots]
        places = [(each.position.start, each.velocity.start) for each in free if each is not None]
        if len(places) < len(slots) or any(len(slot.roots) > 1 for slot in slots):
            return None
        dofs = [
            (owner, column)
            for owner, slot in enumerate(slots)
            for name in slot.joints
            for each in layout.joint(name)
            for column in range(each.velocity.start, each.velocity.stop)
        ]
        owners, columns = np.array(dofs, np.intp).reshape(-1, 2).T.copy()
        return LevelMotion(
            linear,
            angular,
            state.qpos,
            state.qvel,
            np.array(places, np.intp),
            np.array([(*slot.offset.position, *slot.offset.quaternion) for slot in slots]),
            owners,
            columns,
            self._run.moved[1:],
        )
