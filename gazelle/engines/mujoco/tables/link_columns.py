"""Columns of the poses and velocities of links in MuJoCo's arrays."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats, Indices, Worlds
from gazelle.engines.motion import Motion, Placement
from gazelle.engines.mujoco.layout import LinkSlot, MujocoLayout
from gazelle.engines.mujoco.quaternions import xyzw_from_wxyz
from gazelle.engines.mujoco.worlds import RunningWorlds
from gazelle.rotations import cross, rotate

Columns = Indices | slice | int


def some_of(array: Floats, worlds: Worlds | None, columns: Columns) -> Floats:
    """Return columns of an array for some worlds; a view where it can be."""
    return (array if worlds is None else array[worlds])[:, columns]


class LinkColumns(ABC):
    """Links that move alike, in MuJoCo's arrays.

    Indices of one link drop the axis of links from what is read, those of several keep it.
    """

    __slots__ = ()

    @abstractmethod
    def placement(self, run: RunningWorlds, worlds: Worlds | None) -> Placement:
        """Return the poses."""

    @abstractmethod
    def motion(self, run: RunningWorlds, worlds: Worlds | None) -> Motion:
        """Return the velocities."""


class FreeLinks(LinkColumns):
    """Roots of trees that move freely."""

    __slots__ = ("_alone", "_places", "_quaternions", "_rates")

    def __init__(self, slots: Sequence[LinkSlot], *, single: bool) -> None:
        self._alone = len(slots) == 1 and not single  # a view, with an axis of one link
        single = single or self._alone
        free = [slot.free for slot in slots if slot.free is not None]
        self._places = _columns([each.position for each in free], single=single)
        turns = [slice(each.position.start + 3, each.position.stop) for each in free]
        self._quaternions = _columns(turns, single=single)
        self._rates = _columns([each.velocity for each in free], single=single)

    def placement(self, run: RunningWorlds, worlds: Worlds | None) -> Placement:
        """Return the poses."""
        q = self._of(run.state.qpos, worlds, self._places)
        return Placement(q[..., :3].copy(), xyzw_from_wxyz(q[..., 3:]))

    def motion(self, run: RunningWorlds, worlds: Worlds | None) -> Motion:
        """Return the velocities; MuJoCo's angular ones are in the link's frame."""
        v = self._of(run.state.qvel, worlds, self._rates)
        q = self._of(run.state.qpos, worlds, self._quaternions)
        return Motion(v[..., :3].copy(), rotate(xyzw_from_wxyz(q), v[..., 3:]))

    def _of(self, array: Floats, worlds: Worlds | None, columns: Columns) -> Floats:
        found = some_of(array, worlds, columns)
        return found[:, None] if self._alone else found


class KinematicLinks(LinkColumns):
    """Links that move only when they are placed."""

    __slots__ = ("_rows", "_shape")

    def __init__(self, slots: Sequence[LinkSlot], *, single: bool) -> None:
        self._rows = _index([slot.mocap or 0 for slot in slots], single=single)
        self._shape = (3,) if single else (len(slots), 3)

    def placement(self, run: RunningWorlds, worlds: Worlds | None) -> Placement:
        """Return the poses."""
        position = some_of(run.state.mocap_pos, worlds, self._rows)
        quaternion = some_of(run.state.mocap_quat, worlds, self._rows)
        return Placement(position.copy(), xyzw_from_wxyz(quaternion))

    def motion(self, run: RunningWorlds, worlds: Worlds | None) -> Motion:
        """Return zeros: such links have no velocity."""
        return _at_rest(run, worlds, self._shape)


class StaticLinks(LinkColumns):
    """Links of static models."""

    __slots__ = ("_position", "_quaternion")

    def __init__(self, slots: Sequence[LinkSlot], *, single: bool) -> None:
        position = np.array([slot.pose.position for slot in slots])
        quaternion = np.array([slot.pose.quaternion for slot in slots])
        self._position = position[0] if single else position
        self._quaternion = quaternion[0] if single else quaternion

    def placement(self, run: RunningWorlds, worlds: Worlds | None) -> Placement:
        """Return the poses, read-only."""
        count = run.nworld if worlds is None else len(worlds)
        return Placement(
            np.broadcast_to(self._position, (count, *self._position.shape)),
            np.broadcast_to(self._quaternion, (count, *self._quaternion.shape)),
        )

    def motion(self, run: RunningWorlds, worlds: Worlds | None) -> Motion:
        """Return zeros."""
        return _at_rest(run, worlds, self._position.shape)


class InnerLinks(LinkColumns):
    """Links that hang on others."""

    __slots__ = ("_bodies",)

    def __init__(self, slots: Sequence[LinkSlot], *, single: bool) -> None:
        self._bodies = _index([slot.body for slot in slots], single=single)

    def placement(self, run: RunningWorlds, worlds: Worlds | None) -> Placement:
        """Return the poses."""
        run.refresh()
        position = some_of(run.batch.xpos, worlds, self._bodies)
        quaternion = some_of(run.batch.xquat, worlds, self._bodies)
        return Placement(position.copy(), xyzw_from_wxyz(quaternion))

    def motion(self, run: RunningWorlds, worlds: Worlds | None) -> Motion:
        """Return the velocities; MuJoCo's are about the centre of mass of the whole tree."""
        run.refresh()
        spatial = some_of(run.batch.cvel, worlds, self._bodies)
        roots = run.batch.model.body_rootid[self._bodies]
        centre = some_of(run.batch.subtree_com, worlds, roots)
        arm = some_of(run.batch.xpos, worlds, self._bodies) - centre
        angular = spatial[..., :3].copy()
        return Motion(spatial[..., 3:] + cross(angular, arm), angular)


class MixedLinks(LinkColumns):
    """Links that move in different ways.

    Args:
        parts: Those that move alike, and where they are among all.
        count: Number of links.
    """

    __slots__ = ("_count", "_parts")

    def __init__(self, parts: Sequence[tuple[Indices, LinkColumns]], count: int) -> None:
        self._parts, self._count = parts, count

    def placement(self, run: RunningWorlds, worlds: Worlds | None) -> Placement:
        """Return the poses."""
        count = run.nworld if worlds is None else len(worlds)
        position, quaternion = np.empty((count, self._count, 3)), np.empty((count, self._count, 4))
        for where, part in self._parts:
            place = part.placement(run, worlds)
            position[:, where], quaternion[:, where] = place.position, place.quaternion
        return Placement(position, quaternion)

    def motion(self, run: RunningWorlds, worlds: Worlds | None) -> Motion:
        """Return the velocities."""
        count = run.nworld if worlds is None else len(worlds)
        linear, angular = np.empty((2, count, self._count, 3))
        for where, part in self._parts:
            motion = part.motion(run, worlds)
            linear[:, where], angular[:, where] = motion.linear, motion.angular
        return Motion(linear, angular)


def find_links(layout: MujocoLayout, names: Sequence[str], *, single: bool) -> LinkColumns:
    """Return the columns of links.

    Raises:
        EngineError: There is no such link.
    """
    slots = [layout.link(name) for name in names]
    kinds = [_kind(slot) for slot in slots]
    if len(set(kinds)) == 1:
        return kinds[0](slots, single=single)
    parts = []
    for kind in dict.fromkeys(kinds):
        where = np.array([i for i, each in enumerate(kinds) if each is kind], np.intp)
        parts.append((where, kind([slots[i] for i in where], single=False)))
    return MixedLinks(parts, len(slots))


def _kind(
    slot: LinkSlot,
) -> type[FreeLinks | KinematicLinks | StaticLinks | InnerLinks]:
    if slot.free is not None:
        return FreeLinks
    if slot.mocap is not None:
        return KinematicLinks
    return StaticLinks if slot.root == "static" else InnerLinks


def _at_rest(run: RunningWorlds, worlds: Worlds | None, shape: tuple[int, ...]) -> Motion:
    zeros = np.zeros((run.nworld if worlds is None else len(worlds), *shape))
    return Motion(zeros, zeros)


def _index(numbers: Sequence[int], *, single: bool) -> Columns:
    return numbers[0] if single else np.array(numbers, np.intp)


def _columns(slices: Sequence[slice], *, single: bool) -> Columns:
    if single:
        return slices[0]
    return np.array([range(each.start, each.stop) for each in slices], np.intp)
