"""Where many links are at once and how they move, to the bit as one by one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from mujoco.batch import Batch

from gazelle.array_types import Indices, Worlds
from gazelle.engines.motion import Motion, Placement
from gazelle.engines.mujoco.layout import LinkSlot, MujocoLayout
from gazelle.engines.mujoco.order import xyzw_from_wxyz
from gazelle.engines.mujoco.views import StateViews
from gazelle.rotations import cross, rotate


class MujocoLinkTable:
    """Some links of a layout, looked up once.

    Args:
        layout: Of what runs.
        links: Their scoped names.

    Attributes:
        layout: As given; another one has other links.
        moving: Whether any of them moves other than as the root of a tree.

    Raises:
        EngineError: There is no such link.
    """

    def __init__(self, layout: MujocoLayout, links: Sequence[str]) -> None:
        self.layout = layout
        slots = [layout.link(link) for link in links]
        self._at = np.array([slot.pose.position for slot in slots]).reshape(-1, 3)
        self._turned = np.array([slot.pose.quaternion for slot in slots]).reshape(-1, 4)
        free = [slot.free for slot in slots]
        self._free = _where(each is not None for each in free)
        some = [each for each in free if each is not None]
        self._places = _columns([each.position for each in some], 7)
        self._rates = _columns([each.velocity for each in some], 6)
        self._mocap = _where(slot.free is None and slot.mocap is not None for slot in slots)
        self._rows = np.array([slots[i].mocap for i in self._mocap], np.intp)
        self._inner = _where(_is_inner(slot) for slot in slots)
        self._bodies = np.array([slots[i].body for i in self._inner], np.intp)
        self.moving = bool(len(self._inner))

    def placement(self, batch: Batch, state: StateViews, worlds: Worlds | None) -> Placement:
        """Positions [m], shape (n, links, 3), and quaternions (x, y, z, w), shape (n, links, 4).

        Args:
            batch: In which bodies have been placed.
            state: Of that batch.
            worlds: Which worlds; all if None.
        """
        rows = slice(None) if worlds is None else worlds
        count = len(state.qpos) if worlds is None else len(worlds)
        at = np.repeat(self._at[None], count, axis=0)
        turned = np.repeat(self._turned[None], count, axis=0)
        if len(self._free):
            q = state.qpos[rows][:, self._places]
            at[:, self._free], turned[:, self._free] = q[..., :3], xyzw_from_wxyz(q[..., 3:])
        if len(self._mocap):
            at[:, self._mocap] = state.mocap_pos[rows][:, self._rows]
            turned[:, self._mocap] = xyzw_from_wxyz(state.mocap_quat[rows][:, self._rows])
        if self.moving:
            at[:, self._inner] = batch.xpos[rows][:, self._bodies]
            turned[:, self._inner] = xyzw_from_wxyz(batch.xquat[rows][:, self._bodies])
        return Placement(at, turned)

    def motion(self, batch: Batch, state: StateViews) -> Motion:
        """Velocities [m/s, rad/s] in the world frame, shape (nworld, links, 3); see ``placement``."""
        linear, angular = np.zeros((2, len(state.qvel), len(self._at), 3))
        if len(self._free):
            v, q = state.qvel[:, self._rates], state.qpos[:, self._places[:, 3:]]
            linear[:, self._free] = v[..., :3]
            angular[:, self._free] = rotate(xyzw_from_wxyz(q), v[..., 3:])
        if self.moving:
            # MuJoCo's cvel is about the centre of mass of the whole tree.
            roots = batch.model.body_rootid[self._bodies]
            spatial = batch.cvel[:, self._bodies]
            arm = batch.xpos[:, self._bodies] - batch.subtree_com[:, roots]
            angular[:, self._inner] = spatial[..., :3]
            linear[:, self._inner] = spatial[..., 3:] + cross(spatial[..., :3], arm)
        return Motion(linear, angular)


def _is_inner(slot: LinkSlot) -> bool:
    """Whether a link is no root, and moves as what it hangs on."""
    return slot.free is None and slot.mocap is None and slot.root != "static"


def _where(flags: Iterable[bool]) -> Indices:
    return np.flatnonzero(np.fromiter(flags, np.bool_))


def _columns(slices: Sequence[slice], width: int) -> Indices:
    """The columns of slices, shape (n, width)."""
    columns = [np.arange(each.start, each.stop) for each in slices]
    return np.array(columns, np.intp).reshape(-1, width)
