"""Put links somewhere, push them, and hold them together."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.engines.hanging_links import HangingLinks
from gazelle.engines.motion import Motion, Placement
from gazelle.engines.mujoco.attachments import Attachment
from gazelle.engines.mujoco.joint_access import JointAccess
from gazelle.engines.mujoco.layout import LinkSlot
from gazelle.engines.mujoco.links import LinkAccess
from gazelle.engines.mujoco.models import ModelAccess
from gazelle.engines.mujoco.rows import rows_of, unit
from gazelle.engines.mujoco.running import RunningWorlds
from gazelle.errors import EngineError
from gazelle.rotations import conjugate, cross, multiply, rotate


class LinkHandling:
    """The part of ``gazelle.engines.engine.Engine`` that handles single links.

    Args:
        run: What runs.
        links: Where links are.
        models: Puts their roots somewhere.
        joints: Moves the joints that they hang on.
    """

    def __init__(
        self, run: RunningWorlds, links: LinkAccess, models: ModelAccess, joints: JointAccess
    ) -> None:
        self._run, self._links, self._models = run, links, models
        self._hanging = HangingLinks(lambda: run.world, links, joints)

    # -- placing -----------------------------------------------------------------------

    def set_link_placement(
        self, link: str, position: ArrayLike, quaternion: ArrayLike, worlds: Worlds | None = None
    ) -> str:
        """Move a link, or its joint as far as that allows; see the protocol."""
        slot = self._run.now().link(link)
        if slot.root == "static":
            self._run.make_kinematic(link.partition("::")[0])
            slot = self._run.now().link(link)
        here = self._links.link_placement(link, worlds)
        goal_p = np.broadcast_to(np.asarray(position, np.float64), here.position.shape)
        goal_q = unit(np.broadcast_to(np.asarray(quaternion, np.float64), here.quaternion.shape))
        joint = "" if slot.root else self._hanging.place(link, Placement(goal_p, goal_q), worlds)
        if joint:
            return joint
        carrier = self._loose_carrier(link, slot)
        root = self._links.link_placement(slot.carrier, worlds)
        turn = multiply(goal_q, conjugate(here.quaternion))
        moved = goal_p + rotate(turn, root.position - here.position)
        self._models.put(carrier, moved, multiply(turn, root.quaternion), worlds)
        self._run.stale = True
        return ""

    def set_link_motion(
        self, link: str, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give a link a velocity, or its joint what suits it; see the protocol."""
        slot = self._run.now().link(link)
        motion = self._links.link_motion(link, worlds)
        speed = np.broadcast_to(np.asarray(linear, np.float64), motion.linear.shape)
        spin = np.broadcast_to(np.asarray(angular, np.float64), motion.angular.shape)
        if slot.root is None and self._hanging.move(link, Motion(speed, spin), worlds):
            return
        carrier = self._loose_carrier(link, slot)
        if carrier.free is None:
            if not (speed.any() or spin.any()):
                return
            raise EngineError(f"link '{link}' moves only when it is placed; it has no velocity")
        here = self._links.link_placement(link, worlds)
        root, carried = self._of_carrier(slot, worlds)
        more_spin, more = spin - motion.angular, speed - motion.linear
        arm = root.position - here.position
        velocity = carried[0] + more + cross(more_spin, arm)
        local = rotate(conjugate(root.quaternion), carried[1] + more_spin)
        both = np.concatenate((velocity, local), axis=1)
        self._run.state.qvel[rows_of(worlds), carrier.free.velocity] = both
        self._run.stale = True

    def _of_carrier(
        self, slot: LinkSlot, worlds: Worlds | None
    ) -> tuple[Placement, tuple[Floats, Floats]]:
        motion = self._links.link_motion(slot.carrier, worlds)
        return self._links.link_placement(slot.carrier, worlds), (motion.linear, motion.angular)

    def _loose_carrier(self, link: str, slot: LinkSlot) -> LinkSlot:
        """The root of the tree that a link is in, which can be put somewhere."""
        carrier = self._run.layout.link(slot.carrier)
        if carrier.free is None and carrier.mocap is None:
            raise EngineError(
                f"link '{link}' is fixed to the world and cannot be moved",
                hint="only links that hang on a joint that moves can, or of free models",
            )
        return carrier

    # -- pushing -----------------------------------------------------------------------

    def link_centre(self, link: str, worlds: Worlds | None = None) -> Floats:
        """Where a link's centre of mass is [m], in the world frame, shape (n, 3)."""
        place = self._links.link_placement(link, worlds)
        slot = self._run.layout.link(link)
        if slot.body == 0 or slot.mocap is not None:
            return place.position
        offset = self._run.parameter("link_centre", link, worlds)
        return place.position + rotate(place.quaternion, offset)

    def set_link_wrench(
        self, link: str, force: ArrayLike, torque: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Push a link at its centre of mass until told otherwise, in the world frame."""
        slot = self._run.now().link(link)
        if slot.body == 0 or slot.mocap is not None:
            raise EngineError(f"link '{link}' does not move; nothing can push it")
        rows = rows_of(worlds)
        self._run.state.xfrc_applied[rows, slot.body, :3] = force
        self._run.state.xfrc_applied[rows, slot.body, 3:] = torque

    # -- holding -----------------------------------------------------------------------

    def attach(
        self,
        parent: str,
        child: str,
        worlds: Worlds | None = None,
        settling: float | None = None,
    ) -> None:
        """Hold two links together as they are to each other now; see the protocol."""
        if settling is not None and not (math.isfinite(settling) and settling > 0.0):
            raise EngineError(f"links cannot come together within {settling} s", hint="above 0")
        pair = Attachment(parent, child, settling)
        ends = [self._run.now().link(link).body for link in (parent, child)]
        if ends[0] == ends[1]:
            raise EngineError(f"'{parent}' and '{child}' cannot move against each other anyway")
        layout = self._run.prepare(pair)
        base, held = self._body_placement(parent, worlds), self._body_placement(child, worlds)
        back = conjugate(base.quaternion)
        position = rotate(back, held.position - base.position)
        pose = np.concatenate((position, multiply(back, held.quaternion)), axis=1)
        self._run.set_parameter("attachment", pair.name, pose, worlds)
        self._run.batch.eq_active[rows_of(worlds), layout.attachments[pair.name]] = 1.0

    def _body_placement(self, link: str, worlds: Worlds | None) -> Placement:
        """Where MuJoCo's body of a link is: the world's at the origin."""
        place = self._links.link_placement(link, worlds)
        if self._run.layout.link(link).body != 0:
            return place
        upright = np.zeros_like(place.quaternion)
        upright[:, 3] = 1.0
        return Placement(np.zeros_like(place.position), upright)

    def detach(self, parent: str, child: str, worlds: Worlds | None = None) -> None:
        """Let go two links that ``attach`` holds together."""
        name = Attachment(parent, child).name
        layout = self._run.now()
        if name not in layout.attachments:
            raise EngineError(f"'{child}' was never attached to '{parent}'")
        self._run.batch.eq_active[rows_of(worlds), layout.attachments[name]] = 0.0
