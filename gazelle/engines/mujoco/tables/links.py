"""Rows of links in MuJoCo's arrays."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.engines.hanging_links import HangingLinks
from gazelle.engines.motion import Hits, Motion, Placement
from gazelle.engines.mujoco.layout import LinkSlot, MujocoLayout
from gazelle.engines.mujoco.rays import cast_from
from gazelle.engines.mujoco.state import rows_of
from gazelle.engines.mujoco.step_forces import ForcedSteps
from gazelle.engines.mujoco.tables.link_columns import LinkColumns, find_links
from gazelle.engines.mujoco.tables.root_poses import put_root
from gazelle.engines.mujoco.worlds import RunningWorlds
from gazelle.engines.state import LinkRow
from gazelle.engines.table import Lookup
from gazelle.errors import EngineError
from gazelle.rotations import conjugate, cross, multiply, rotate, unit


class MujocoLinkRows:
    """Several links; see ``gazelle.engines.state.LinkRows``.

    Args:
        run: Worlds that run.
        steps: Makes the next step.
        names: Scoped names.
        single: Leave out the axis of links, of one link.
    """

    def __init__(
        self,
        run: RunningWorlds,
        steps: ForcedSteps,
        names: tuple[str, ...],
        *,
        single: bool = False,
    ) -> None:
        self._run, self._steps, self._names = run, steps, names
        self._columns = Lookup[MujocoLayout, LinkColumns](
            lambda layout: find_links(layout, names, single=single)
        )

    def placement(self, worlds: Worlds | None = None) -> Placement:
        """Return the poses of the links."""
        return self._columns.within(self._run.known()).placement(self._run, worlds)

    def motion(self, worlds: Worlds | None = None) -> Motion:
        """Return the velocities of the links."""
        return self._columns.within(self._run.known()).motion(self._run, worlds)

    def acceleration(self, worlds: Worlds | None = None) -> Motion:
        """Return by how much the velocities change in the next physics step [m/s², rad/s²]."""
        return self._steps.change_in_step(lambda: self.motion(worlds), worlds)


class MujocoLinkRow(MujocoLinkRows):
    """One link; see ``gazelle.engines.state.LinkRow``.

    Args:
        run: Worlds that run.
        steps: Makes the next step.
        name: Scoped name.
        link: Returns another link by its name.
        hanging: Moves links by the joints that they hang on.
        make_kinematic: The engine's.
    """

    def __init__(
        self,
        run: RunningWorlds,
        steps: ForcedSteps,
        name: str,
        link: Callable[[str], LinkRow],
        hanging: HangingLinks,
        make_kinematic: Callable[[str], None],
    ) -> None:
        super().__init__(run, steps, (name,), single=True)
        self._name, self._link, self._hanging = name, link, hanging
        self._make_kinematic = make_kinematic

    def centre(self, worlds: Worlds | None = None) -> Floats:
        """Return the centre of mass [m], in the world frame, shape (n, 3)."""
        place = self.placement(worlds)
        slot = self._run.layout.link(self._name)
        if slot.body == 0 or slot.mocap is not None:
            return place.position
        offset = self._run.parameter("link_centre", self._name, worlds)
        return place.position + rotate(place.quaternion, offset)

    def cast_rays(
        self,
        origins: Floats,
        directions: Floats,
        worlds: Worlds | None = None,
        *,
        ignore_own: bool = False,
    ) -> Hits:
        """Cast rays that move with the link to the nearest collision shape."""
        place, rays = self.placement(worlds), (origins, directions)
        return cast_from(self._run, self._name, place, rays, worlds, ignore_own=ignore_own)

    def set_placement(
        self, position: ArrayLike, quaternion: ArrayLike, worlds: Worlds | None = None
    ) -> str:
        """Move the link, or its joint as far as that allows."""
        slot = self._run.up_to_date().link(self._name)
        if slot.root == "static":
            self._make_kinematic(self._name.partition("::")[0])
            slot = self._run.up_to_date().link(self._name)
        here = self.placement(worlds)
        goal_p = np.broadcast_to(np.asarray(position, np.float64), here.position.shape)
        goal_q = unit(np.broadcast_to(np.asarray(quaternion, np.float64), here.quaternion.shape))
        goal = Placement(goal_p, goal_q)
        joint = "" if slot.root else self._hanging.place(self._name, goal, worlds)
        if joint:
            return joint
        carrier = self._free_carrier(slot)
        root = self._link(slot.carrier).placement(worlds)
        turn = multiply(goal_q, conjugate(here.quaternion))
        moved = goal_p + rotate(turn, root.position - here.position)
        put_root(self._run, carrier, moved, multiply(turn, root.quaternion), worlds)
        self._run.stale = True
        return ""

    def set_motion(
        self, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set the velocity of the link, or the speed of its joint that suits it."""
        slot = self._run.up_to_date().link(self._name)
        motion = self.motion(worlds)
        speed = np.broadcast_to(np.asarray(linear, np.float64), motion.linear.shape)
        spin = np.broadcast_to(np.asarray(angular, np.float64), motion.angular.shape)
        if slot.root is None and self._hanging.move(self._name, Motion(speed, spin), worlds):
            return
        carrier = self._free_carrier(slot)
        if carrier.free is None:
            if not (speed.any() or spin.any()):
                return
            raise EngineError(f"link '{self._name}' is kinematic and has no velocity")
        here, row = self.placement(worlds), self._link(slot.carrier)
        root, motion = row.placement(worlds), row.motion(worlds)
        more_spin, more = spin - motion.angular, speed - motion.linear
        arm = root.position - here.position
        velocity = motion.linear + more + cross(more_spin, arm)
        local = rotate(conjugate(root.quaternion), motion.angular + more_spin)
        both = np.concatenate((velocity, local), axis=1)
        self._run.state.qvel[rows_of(worlds), carrier.free.velocity] = both
        self._run.stale = True

    def _free_carrier(self, slot: LinkSlot) -> LinkSlot:
        """Return the root of the tree that the link is in, which can be placed."""
        carrier = self._run.layout.link(slot.carrier)
        if carrier.free is None and carrier.mocap is None:
            raise EngineError(
                f"link '{self._name}' is fixed to the world and cannot be moved",
                hint="only links on movable joints and links of free models can be moved",
            )
        return carrier

    def set_wrench(self, force: ArrayLike, torque: ArrayLike, worlds: Worlds | None = None) -> None:
        """Apply a wrench at the centre of mass until another is set, in the world frame."""
        slot = self._run.up_to_date().link(self._name)
        if slot.body == 0 or slot.mocap is not None:
            raise EngineError(f"link '{self._name}' is static; no force can act on it")
        rows = rows_of(worlds)
        self._run.state.xfrc_applied[rows, slot.body, :3] = force
        self._run.state.xfrc_applied[rows, slot.body, 3:] = torque
