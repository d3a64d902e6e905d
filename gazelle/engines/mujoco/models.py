"""Where models are, and how they are put elsewhere and made to move."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.engines.motion import Placement
from gazelle.engines.mujoco.layout import LinkSlot, ModelSlot
from gazelle.engines.mujoco.links import LinkAccess
from gazelle.engines.mujoco.order import wxyz_from_xyzw
from gazelle.engines.mujoco.rows import rows_of, unit
from gazelle.engines.mujoco.running import RunningWorlds
from gazelle.errors import EngineError
from gazelle.rotations import conjugate, cross, from_yaw, multiply, rotate, yaw_of


class ModelAccess:
    """The part of ``gazelle.engines.engine.Engine`` for whole models.

    Args:
        run: What runs.
        links: Where links are.
    """

    def __init__(self, run: RunningWorlds, links: LinkAccess) -> None:
        self._run, self._links = run, links

    def model_placement(self, model: str, worlds: Worlds | None = None) -> Placement:
        """Where a model's frame is: it moves with the canonical link."""
        slot = self._run.known().model(model)
        link = self._links.link_placement(slot.canonical, worlds)
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
        slot = self._run.now().model(model)
        if not slot.loose:
            slot = self._loosen(model, slot)
        goal_p, goal_q = np.asarray(position, np.float64), np.asarray(quaternion, np.float64)
        if len(slot.roots) == 1:
            self._put_only(slot, goal_p, goal_q, worlds)
        else:
            self._put_all(model, slot, goal_p, unit(goal_q), worlds)
        self._run.stale = True

    def _loosen(self, model: str, slot: ModelSlot) -> ModelSlot:
        """Make a static model one that can be placed.

        Raises:
            EngineError: A joint holds the model to the world.
        """
        if any(self._run.layout.link(root).root == "static" for root in slot.roots):
            self._run.make_kinematic(model)
            slot = self._run.now().model(model)
        fixed = [root for root in slot.roots if self._run.layout.link(root).root is None]
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
        self.put(self._run.layout.link(slot.roots[0]), position, quaternion, worlds)

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
            link = self._links.link_placement(root, worlds)
            moved = goal_p + rotate(turn, link.position - before.position)
            self.put(self._run.layout.link(root), moved, multiply(turn, link.quaternion), worlds)

    def put(
        self, slot: LinkSlot, position: Floats, quaternion: Floats, worlds: Worlds | None
    ) -> None:
        """Put the root of a tree of links somewhere; see ``set_link_placement``."""
        rows = rows_of(worlds)
        self._run.placed = True
        # Normalised, or rounding errors would grow with every relative move.
        wxyz = wxyz_from_xyzw(unit(quaternion))
        if slot.mocap is not None:
            self._run.state.mocap_pos[rows, slot.mocap] = position
            self._run.state.mocap_quat[rows, slot.mocap] = wxyz
        elif slot.free is not None:
            self._run.dropped.setdefault(slot.body, np.zeros(self._run.nworld, np.bool_))[rows] = (
                True
            )
            start = slot.free.position.start
            self._run.state.qpos[rows, start : start + 3] = position
            self._run.state.qpos[rows, start + 3 : start + 7] = wxyz

    def set_model_motion(
        self, model: str, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give all links of a model the velocity of one rigid body, joints at rest."""
        slot = self._run.now().model(model)
        rows = rows_of(worlds)
        origin = self.model_placement(model, worlds)
        v = np.broadcast_to(np.asarray(linear, np.float64), origin.position.shape)
        w = np.broadcast_to(np.asarray(angular, np.float64), origin.position.shape)
        for root in slot.roots:
            free = self._run.layout.link(root).free
            if free is None:
                continue
            link = self._links.link_placement(root, worlds)
            at_link = v + cross(w, link.position - origin.position)
            local = rotate(conjugate(link.quaternion), w)
            self._run.state.qvel[rows, free.velocity] = np.concatenate((at_link, local), axis=1)
        for joint in slot.joints:
            for each in self._run.layout.joint(joint):
                self._run.state.qvel[rows, each.velocity] = 0.0
        self._run.stale = True

    def set_ground_motion(self, model: str, twist: ArrayLike, worlds: Worlds | None = None) -> None:
        """Give all links of a model a level velocity along and across its heading."""
        heading = from_yaw(yaw_of(self.model_placement(model, worlds).quaternion))
        wanted = np.atleast_2d(np.asarray(twist, np.float64))
        level, spin = wanted * (1.0, 1.0, 0.0), wanted * (0.0, 0.0, 1.0)
        self.set_model_motion(model, rotate(heading, level), spin, worlds)
