"""A base that is pushed to the velocity of its command: ``libgazebo_ros_force_based_move.so``."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.description import Parameters
from gazelle.engines import Placement
from gazelle.plugins.odometry import OdometryOutputs
from gazelle.rotations import conjugate, rotate
from gazelle.simulation import (
    ModelPlugin,
    Odometry,
    Robot,
    Schedule,
    TwistInput,
    absolute,
    namespace_of,
)
from gazelle.simulation.values import SixNumbers

_UNSURE = 1e12
# Turning slower than this counts as not turning [rad/s].
_STILL = 1e-4


class ForceBasedMove(ModelPlugin):
    """Pushes the base with forces proportional to what its velocity lacks.

    The gains are those of the file, but never more than what takes the whole model to its
    velocity within one step: beyond that the original swings. The odometry starts at zero
    where the model starts.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, open ``cmd_vel`` and ``odom``."""
        self._robot, self._simulation = robot, robot.simulation
        self._clock = robot.simulation.clock
        self._frame = parameters.get("odometryFrame", "odom")
        self._base = parameters.get("robotBaseFrame", "base_footprint")
        self._link, _ = robot.frame(self._base)
        x = parameters.get("x_velocity_p_gain", 10000.0)
        y = parameters.get("y_velocity_p_gain", 10000.0)
        self._gains = np.array([x, y, 0.0])
        self._turning_gain = parameters.get("yaw_velocity_p_gain", 100.0)
        namespace = namespace_of(robot, parameters)
        topic = absolute(namespace, parameters.get("commandTopic", "cmd_vel"))
        self._command = robot.inputs["cmd_vel"] = TwistInput(robot.simulation.nworld, topic)
        rate = parameters.get("odometryRate", 20.0)
        self._schedule = Schedule(rate) if rate > 0.0 else None
        odometry = absolute(namespace, parameters.get("odometryTopic", "odom"))
        framed = parameters.get("publishOdometryTf", True)
        self._odometry = OdometryOutputs(robot, odometry, self._measure, namespace, framed=framed)
        self._start = robot.placement()

    def on_update(self, time: float) -> None:  # noqa: ARG002  forces act at every step
        """Apply force and torque, and publish when it is due."""
        place, motion = self._robot.placement(), self._robot.motion()
        step = self._simulation.engine.time_step
        own = rotate(conjugate(place.quaternion), motion.linear)
        mass, inertia = self._weight(place)
        gains = np.minimum(self._gains, mass[:, None] / step)
        force = rotate(place.quaternion, gains * (self._command.linear - own))
        gain = np.minimum(self._turning_gain, inertia / step)
        torque = np.zeros_like(force)
        torque[:, 2] = gain * (self._command.angular[:, 2] - motion.angular[:, 2])
        self._simulation.applied_wrenches.hold("force_based_move", self._link.name, force, torque)
        if self._schedule is not None and self._schedule.is_due(self._clock.now_ns):
            self._schedule.done(self._clock.now_ns)
            self._odometry.publish()

    def _weight(self, place: Placement) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the model's mass and its least inertia about the vertical, shape (nworld,)."""
        engine = self._simulation.engine
        mass, inertia = np.zeros((2, len(place.position)))
        for link in self._robot.links.values():
            own = engine.parameter("link_mass", link.name)[:, 0]
            arm = engine.links[link.name].centre()[:, :2] - place.position[:, :2]
            mass += own
            inertia += own * (arm * arm).sum(axis=1)
            inertia += engine.parameter("link_inertia", link.name)[:, :3].min(axis=1)
        return mass, inertia

    def _measure(self) -> Odometry:
        place, motion = self._robot.placement(), self._robot.motion()
        seen = place.relative_to(self._start)
        back = conjugate(place.quaternion)
        turning = bool((np.abs(motion.angular[:, 2]) >= _STILL).any())
        yaw = 100.0 if turning else 0.01
        pose: SixNumbers = (0.001, 0.001, _UNSURE, _UNSURE, _UNSURE, yaw)
        twist: SixNumbers = (0.001, 0.001, 0.001, _UNSURE, _UNSURE, yaw)
        return Odometry(
            self._clock.now_ns,
            self._frame,
            self._base,
            seen.position,
            seen.quaternion,
            rotate(back, motion.linear),
            rotate(back, motion.angular),
            pose,
            twist,
        )

    def reset(self, worlds: Worlds | None) -> None:
        """Reset the odometry."""
        rows = slice(None) if worlds is None else worlds
        place = self._robot.placement(worlds)
        self._start.position[rows], self._start.quaternion[rows] = place.position, place.quaternion
        if worlds is None and self._schedule is not None:
            self._schedule.restart()

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the origin of the odometry."""
        return {
            "position": self._start.position.copy(),
            "quaternion": self._start.quaternion.copy(),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._start.position[:], self._start.quaternion[:] = state["position"], state["quaternion"]
        if self._schedule is not None:
            self._schedule.done(self._clock.now_ns)
