"""Read and write where the links of planar models are, and how they move."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.description import Pose
from gazelle.engines.hanging_links import HangingLinks
from gazelle.engines.motion import Motion, Placement
from gazelle.engines.mujoco.rows import unit
from gazelle.engines.planar.joints import PlanarJoints
from gazelle.engines.planar.link_table import PlanarLinkTable
from gazelle.engines.planar.models import PlanarModels
from gazelle.engines.planar.running import RunningPlane
from gazelle.engines.planar.skeleton import FROZEN
from gazelle.rotations import conjugate, cross, multiply, rotate


class PlanarLinks:
    """The part of ``gazelle.engines.engine.Engine`` that reads and moves links.

    Args:
        run: What runs.
        models: They are on.
        joints: They hang on.
    """

    def __init__(self, run: RunningPlane, models: PlanarModels, joints: PlanarJoints) -> None:
        self._run, self._models = run, models
        self._hanging = HangingLinks(lambda: run.recipe.world, self, joints, FROZEN)
        self._tables: dict[tuple[str, ...], PlanarLinkTable] = {}
        run.on_change.append(self._tables.clear)

    def link_placement(self, link: str, worlds: Worlds | None = None) -> Placement:
        """Where a link is."""
        model = self._run.owner(link)
        base = self._models.model_placement(model, worlds)
        position, turned = self._run.model(model).skeleton.place(
            link, self._run.own(model, worlds)[0]
        )
        return Placement(
            base.position + rotate(base.quaternion, position), multiply(base.quaternion, turned)
        )

    def link_placements(self, links: Sequence[str], worlds: Worlds | None = None) -> Placement:
        """Where many links are at once: shapes (n, links, 3) and (n, links, 4)."""
        key = tuple(links)
        table = self._tables.get(key)
        if table is None:
            table = self._tables[key] = PlanarLinkTable(self._run.layout, key)
        return table.placement(self._run.fleet, self._run.angles, worlds)

    def link_motion(self, link: str, worlds: Worlds | None = None) -> Motion:
        """How a link moves."""
        model = self._run.owner(link)
        base = self._models.model_placement(model, worlds)
        skeleton = self._run.model(model).skeleton
        angles, rates = self._run.own(model, worlds)
        inner = skeleton.motion(link, angles, rates)
        arm = rotate(base.quaternion, skeleton.place(link, angles)[0])
        linear, spin = self._models.twist(model, worlds)
        linear = linear + cross(spin, arm) + rotate(base.quaternion, inner[0])
        return Motion(linear, spin + rotate(base.quaternion, inner[1]))

    def link_acceleration(self, link: str, worlds: Worlds | None = None) -> Motion:
        """How a link's motion changes: only towards the middle of the arc it is on."""
        motion = self.link_motion(link, worlds)
        spin = self._models.twist(self._run.owner(link), worlds)[1]
        return Motion(cross(spin, motion.linear), np.zeros_like(spin))

    def set_link_placement(
        self, link: str, position: ArrayLike, quaternion: ArrayLike, worlds: Worlds | None = None
    ) -> str:
        """Move a link's model, or its joint as far as that allows; see the protocol."""
        model = self._run.owner(link)
        if self._run.model(model).skeleton.hinges:
            here = self.link_placement(link, worlds)
            goal = Placement(
                np.broadcast_to(np.asarray(position, np.float64), here.position.shape),
                unit(np.broadcast_to(np.asarray(quaternion, np.float64), here.quaternion.shape)),
            )
            if joint := self._hanging.place(link, goal, worlds):
                return joint
        at, turned = self._run.model(model).skeleton.place(link, self._run.own(model, worlds)[0])
        frame = multiply(np.asarray(quaternion, np.float64), conjugate(turned))
        origin = np.asarray(position, np.float64) - rotate(frame, at)
        self._models.set_model_placement(model, origin, frame, worlds)
        return ""

    def set_link_motion(
        self, link: str, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give a link's model or joint the velocity with which the link moves so."""
        model = self._run.owner(link)
        arm = self.link_placement(link, worlds).position
        arm = arm - self._models.model_placement(model, worlds).position
        spin = np.broadcast_to(np.asarray(angular, np.float64), arm.shape)
        speed = np.broadcast_to(np.asarray(linear, np.float64), arm.shape)
        hinged = bool(self._run.model(model).skeleton.hinges)
        if hinged and self._hanging.move(link, Motion(speed, spin), worlds):
            return
        origin = np.asarray(linear, np.float64) - cross(spin, arm)
        self._models.set_model_motion(model, origin, spin, worlds)

    def link_centre(self, link: str, worlds: Worlds | None = None) -> Floats:
        """Where a link's centre of mass is [m], in the world frame, shape (n, 3)."""
        place = self.link_placement(link, worlds)
        inertial = self._run.model(self._run.owner(link)).skeleton.bones[link].link.inertial
        offset = Pose() if inertial is None else inertial.pose
        return place.position + rotate(place.quaternion, np.asarray(offset.position)[None])
