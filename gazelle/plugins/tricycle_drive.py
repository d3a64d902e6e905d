"""One wheel that drives and steers: what ``libgazebo_ros_tricycle_drive.so`` does."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.plugins.dead_reckoning import DeadReckoning
from gazelle.plugins.frames import frames_output, joint_transforms
from gazelle.plugins.odometry import POSE_VARIANCE, OdometryOutputs, TrueOdometry
from gazelle.plugins.publishing import Published
from gazelle.simulation import (
    JointStates,
    ModelPlugin,
    Odometry,
    Output,
    Robot,
    Stopwatch,
    Transforms,
    TwistInput,
    absolute,
    namespace_of,
)

_JOINTS = (
    ("steeringJoint", "front_steering_joint"),
    ("actuatedWheelJoint", "front_wheel_joint"),
    ("encoderWheelLeftJoint", "left_wheel_joint"),
    ("encoderWheelRightJoint", "right_wheel_joint"),
)
_MOST_ANGLE = math.pi / 2.0


class TricycleDrive(ModelPlugin):
    """Takes ``linear.x`` as the speed of the driven wheel and ``angular.z`` as its angle.

    The last command holds for ever.
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, put motors on the wheel, open ``cmd_vel`` and ``odom``."""
        self._robot, self._clock = robot, robot.simulation.clock
        self._read_limits(parameters)
        torque = parameters.get("wheelTorque", 5.0)
        self._names = tuple(parameters.get(tag, name) for tag, name in _JOINTS)
        self._joints = [robot.joints[name] for name in self._names]
        self._steering, self._wheel = self._joints[0], self._joints[1]
        self._wheel.add_motor(torque)
        if self._steering_speed > 0.0:
            self._steering.add_motor(torque)
        source = parameters.get("odometrySource", "world")
        if source not in ("world", "encoder", "0", "1"):
            raise SimulationError(
                f"odometrySource must be world or encoder, not '{source}'",
                source=parameters.source,
            )
        self._from_encoders = source in ("encoder", "0")
        self._reckoning = DeadReckoning(
            parameters.get("encoderWheelSeparation", 0.5),
            parameters.get("encoderWheelDiameter", 0.15) / 2.0,
            self._angles(),
        )
        self.update_rate = parameters.get("updateRate", 100.0)
        self._watch = Stopwatch(robot.simulation.clock)
        self._open_ports(robot, parameters)

    def _read_limits(self, parameters: Parameters) -> None:
        self._radius = parameters.get("actuatedWheelDiameter", 0.15) / 2.0
        if self._radius <= 0.0:
            raise SimulationError(
                "actuatedWheelDiameter must be positive", source=parameters.source
            )
        self._acceleration = parameters.get("wheelAcceleration", 0.0)
        self._deceleration = parameters.get("wheelDeceleration", self._acceleration)
        self._speed_tolerance = parameters.get("wheelSpeedTolerance", 0.01)
        self._steering_speed = parameters.get("steeringSpeed", 0.0)
        self._angle_tolerance = parameters.get("steeringAngleTolerance", 0.01)

    def _open_ports(self, robot: Robot, parameters: Parameters) -> None:
        namespace = namespace_of(robot, parameters, robot.name)
        command = absolute(namespace, parameters.get("commandTopic", "cmd_vel"))
        self._command = robot.inputs["cmd_vel"] = TwistInput(robot.simulation.nworld, command)
        self._frame = parameters.get("odometryFrame", "odom")
        self._base = parameters.get("robotBaseFrame", "base_link")
        topic = absolute(namespace, parameters.get("odometryTopic", "odom"))
        published: list[Published] = [OdometryOutputs(robot, topic, self._measure, namespace)]
        if parameters.get("publishWheelTF", False):
            robot.outputs["wheel_tf"] = frames_output(self._wheel_frames, namespace)
            published.append(robot.outputs["wheel_tf"])
        if parameters.get("publishWheelJointState", False):
            states = absolute(namespace, "joint_states")
            robot.outputs["joint_states"] = Output(
                states, JointStates, self._read_joints, queue_size=1000
            )
            published.append(robot.outputs["joint_states"])
        self._published = tuple(published)

    def on_update(self, time: float) -> None:  # noqa: ARG002  the watch tells
        """Drive, steer and publish."""
        interval = self._watch.lap()
        if self._from_encoders:
            self._reckoning.advance(self._angles(), interval)
        self._drive(interval)
        self._steer()
        for output in self._published:
            output.publish()

    def _drive(self, interval: float) -> None:
        target = self._command.linear[:, 0] / self._radius
        if self._acceleration > 0.0:
            current = self._wheel.velocities()[:, 0]
            lack = target - current
            most = np.where(lack > 0.0, self._acceleration, self._deceleration) * interval
            ramped = current + np.clip(lack, -most, most)
            target = np.where(np.abs(lack) < self._speed_tolerance, current, ramped)
        self._wheel.drive(target)

    def _steer(self) -> None:
        target = np.clip(self._command.angular[:, 2], -_MOST_ANGLE, _MOST_ANGLE)
        if self._steering_speed <= 0.0:
            self._steering.position = target
            self._steering.velocity = np.zeros_like(target)
            return
        lack = target - self._steering.positions()[:, 0]
        pace = np.where(np.abs(lack) < self._angle_tolerance, 0.0, np.sign(lack))
        self._steering.drive(pace * self._steering_speed)

    def _angles(self) -> Floats:
        return np.concatenate([joint.positions()[:, :1] for joint in self._joints[2:]], axis=1)

    def _measure(self) -> Odometry:
        if not self._from_encoders:
            return TrueOdometry(self._robot, self._frame, self._base)()
        now = self._clock.now_ns
        return self._reckoning.odometry(now, self._frame, self._base, POSE_VARIANCE)

    def _wheel_frames(self) -> Transforms:
        return joint_transforms(self._robot, map(self._robot.joint_description, self._names))

    def _read_joints(self) -> JointStates:
        engine = self._robot.simulation.engine
        return JointStates(
            self._clock.now_ns,
            self._names,
            np.concatenate([joint.positions()[:, :1] for joint in self._joints], axis=1),
            np.concatenate([joint.velocities()[:, :1] for joint in self._joints], axis=1),
            np.concatenate([engine.joint_effort(joint.name)[:, :1] for joint in self._joints], 1),
        )

    def reset(self, worlds: Worlds | None) -> None:
        """The odometry starts at its origin."""
        self._reckoning.reset(worlds, self._angles())
        if worlds is None:
            self._watch.restart()

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Odometry and time of the last update."""
        return {**self._reckoning.state(), "last_time": np.array(self._watch.start_ns)}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        self._reckoning.restore(state)
        self._watch.start_ns = int(state["last_time"])
