"""A hand that holds a link where a frame is: what ``libgazebo_ros_hand_of_god.so`` does."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.description import Parameters
from gazelle.plugins.publishing import Publishing
from gazelle.rotations import conjugate, multiply
from gazelle.simulation import Input, Output, Robot, Transform, Transforms

Floats = NDArray[np.float64]
Worlds = NDArray[np.intp]


class HandOfGod(Publishing):
    """Draws a weightless link to the frame ``<frameId>_desired`` in ``world``, without swinging.

    The frame must be given in ``world`` itself. Until it is heard of nothing is done.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the link, listen to tf."""
        self._robot, self._simulation = robot, robot.simulation
        self._link, _ = robot.frame(parameters.require("linkName", str))
        self._link.set_properties(gravity=0.0)
        self._name = parameters.get("frameId", "hog")
        self._stiffness = parameters.get("kl", 200.0), parameters.get("ka", 200.0)
        nworld = robot.simulation.nworld
        self._known = np.zeros(nworld, np.bool_)
        self._position: Floats = np.zeros((nworld, 3))
        self._quaternion: Floats = np.tile([0.0, 0.0, 0.0, 1.0], (nworld, 1))
        robot.inputs[f"{self._name}_desired"] = Input(
            "/tf", Transforms, self._hear, forget=self.reset, queue_size=100
        )
        actual = f"{self._name}_actual"
        robot.outputs[actual] = Output("/tf", Transforms, self._tell)
        self._published.append(robot.outputs[actual])

    @property
    def active(self) -> bool:
        """Whether there is a frame to follow, or anybody listens."""
        return bool(self._known.any()) or super().active

    def _hear(self, transforms: Transforms, worlds: Worlds | None) -> None:
        rows = slice(None) if worlds is None else worlds
        for each in transforms.transforms:
            child = each.child_frame.lstrip("/")
            if child == f"{self._name}_desired" and each.frame.lstrip("/") == "world":
                self._position[rows], self._quaternion[rows] = each.position, each.quaternion
                self._known[rows] = True

    def on_update(self, time: float) -> None:
        """Draw, and tell where the link is."""
        if self._known.any():
            engine, name = self._simulation.engine, self._link.name
            place, motion = self._link.placement(), self._link.motion()
            mass = engine.parameter("link_mass", name)
            inertia = engine.parameter("link_inertia", name)[:, :1]
            linear, angular = self._stiffness
            force = linear * (self._position - place.position)
            force -= 2.0 * np.sqrt(linear * mass) * motion.linear
            turn = multiply(self._quaternion, conjugate(place.quaternion))
            # Twice the vector part, the short way round, is the turn for small angles.
            torque = angular * 2.0 * turn[:, :3] * np.where(turn[:, 3:] < 0.0, -1.0, 1.0)
            torque -= 2.0 * np.sqrt(angular * inertia) * motion.angular
            known = self._known[:, None]
            self._simulation.loads.hold(
                "hand_of_god", name, np.where(known, force, 0.0), np.where(known, torque, 0.0)
            )
        super().on_update(time)

    def _tell(self) -> Transforms:
        place = self._link.placement()
        actual = Transform("world", f"{self._name}_actual", place.position, place.quaternion)
        return Transforms(self._simulation.clock.now_ns, (actual,))

    def reset(self, worlds: Worlds | None) -> None:
        """Follow nothing."""
        self._known[slice(None) if worlds is None else worlds] = False

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """What is followed."""
        return {
            "known": self._known.copy(),
            "position": self._position.copy(),
            "quaternion": self._quaternion.copy(),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        self._known[:] = state["known"]
        self._position[:], self._quaternion[:] = state["position"], state["quaternion"]
