"""One wheel that drives and steers: what ``libgazebo_ros_tricycle_drive.so`` does."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.plugins.dead_reckoning import DeadReckoning, ReckoningGroup, RolledOdometry
from gazelle.plugins.frames import frames_output, joint_transforms
from gazelle.plugins.odometry import (
    POSE_VARIANCE,
    OdometryOutputs,
    OdometrySource,
    OdometrySystem,
    TrueOdometry,
)
from gazelle.simulation import (
    JointArray,
    JointStates,
    ModelPlugin,
    Output,
    Robot,
    Transforms,
    TwistInput,
    absolute,
    namespace_of,
)
from gazelle.simulation.plugin_system import Published

_JOINTS = (
    ("steeringJoint", "front_steering_joint"),
    ("actuatedWheelJoint", "front_wheel_joint"),
    ("encoderWheelLeftJoint", "left_wheel_joint"),
    ("encoderWheelRightJoint", "right_wheel_joint"),
)
_MOST_ANGLE = math.pi / 2.0


@dataclass(frozen=True, slots=True)
class TricycleLimits:
    """Limits of a tricycle's drive and steering.

    Attributes:
        radius: Of the driven wheel [m].
        acceleration: Of the wheel [rad/s²]; 0 for no limit.
        deceleration: Likewise.
        speed_tolerance: Smaller errors of the speed count as none [rad/s].
        steering_speed: [rad/s]; 0 to be there at once.
        angle_tolerance: Smaller errors of the angle count as none [rad].
    """

    radius: float
    acceleration: float
    deceleration: float
    speed_tolerance: float
    steering_speed: float
    angle_tolerance: float

    @classmethod
    def read(cls, parameters: Parameters) -> TricycleLimits:
        """Read the tags.

        Raises:
            SimulationError: The wheel has no size.
        """
        radius = parameters.get("actuatedWheelDiameter", 0.15) / 2.0
        if radius <= 0.0:
            raise SimulationError(
                "actuatedWheelDiameter must be positive", source=parameters.source
            )
        acceleration = parameters.get("wheelAcceleration", 0.0)
        return cls(
            radius,
            acceleration,
            parameters.get("wheelDeceleration", acceleration),
            parameters.get("wheelSpeedTolerance", 0.01),
            parameters.get("steeringSpeed", 0.0),
            parameters.get("steeringAngleTolerance", 0.01),
        )


class TricycleDrive(ModelPlugin):
    """Takes ``linear.x`` as the speed of the driven wheel and ``angular.z`` as its angle.

    The last command holds for ever.

    Attributes:
        limits: Of its speeds and angles.
        odometry: Odometry output.
        reckoning: Of how far the wheels that count have rolled.
        joints: Those that steer, drive, and count.
        from_encoders: Whether the odometry is what wheels have rolled.
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, put motors on the wheel, open ``cmd_vel`` and ``odom``."""
        self._robot, self._clock = robot, robot.simulation.clock
        self.limits = TricycleLimits.read(parameters)
        torque = parameters.get("wheelTorque", 5.0)
        self._names = tuple(parameters.get(tag, name) for tag, name in _JOINTS)
        self.joints = [robot.joints[name] for name in self._names]
        self.joints[1].add_motor(torque)
        if self.limits.steering_speed > 0.0:
            self.joints[0].add_motor(torque)
        source = parameters.get("odometrySource", "world")
        if source not in ("world", "encoder", "0", "1"):
            raise SimulationError(
                f"odometrySource must be world or encoder, not '{source}'",
                source=parameters.source,
            )
        self.from_encoders = source in ("encoder", "0")
        self.system = EncoderTricycles if self.from_encoders else TricycleSystem
        self.reckoning = DeadReckoning(
            self._clock,
            parameters.get("encoderWheelSeparation", 0.5),
            parameters.get("encoderWheelDiameter", 0.15) / 2.0,
            self.joints[2:],
        )
        self.update_rate = parameters.get("updateRate", 100.0)
        self._open_ports(robot, parameters)

    def _open_ports(self, robot: Robot, parameters: Parameters) -> None:
        namespace = namespace_of(robot, parameters, robot.name)
        command = absolute(namespace, parameters.get("commandTopic", "cmd_vel"))
        self._command = robot.inputs["cmd_vel"] = TwistInput(robot.simulation.nworld, command)
        topic = absolute(namespace, parameters.get("odometryTopic", "odom"))
        measure = self._odometry_source(parameters)
        self.odometry = OdometryOutputs(robot, topic, measure, namespace)
        published: list[Published] = [self.odometry]
        if parameters.get("publishWheelTF", False):
            robot.outputs["wheel_tf"] = frames_output(self._wheel_frames, namespace)
            published.append(robot.outputs["wheel_tf"])
        if parameters.get("publishWheelJointState", False):
            states = absolute(namespace, "joint_states")
            robot.outputs["joint_states"] = Output(
                states, JointStates, self._read_joints, queue_size=1000
            )
            published.append(robot.outputs["joint_states"])
        self.published = tuple(published)

    def _odometry_source(self, parameters: Parameters) -> OdometrySource:
        frame = parameters.get("odometryFrame", "odom")
        base = parameters.get("robotBaseFrame", "base_link")
        if not self.from_encoders:
            return TrueOdometry(self._robot, frame, base)
        return RolledOdometry(self.reckoning, frame, base, POSE_VARIANCE)

    def store_in(self, linear: Floats, angular: Floats) -> None:
        """Store commands in other arrays, shape (nworld, 3) each."""
        self._command.store_in(linear, angular)

    def _wheel_frames(self) -> Transforms:
        return joint_transforms(self._robot, map(self._robot.joint_description, self._names))

    def _read_joints(self) -> JointStates:
        engine = self._robot.simulation.engine
        return JointStates(
            self._clock.now_ns,
            self._names,
            np.concatenate([joint.positions()[:, :1] for joint in self.joints], axis=1),
            np.concatenate([joint.velocities()[:, :1] for joint in self.joints], axis=1),
            np.concatenate([engine.joints[joint.name].effort()[:, :1] for joint in self.joints], 1),
        )

    def reset(self, worlds: Worlds | None) -> None:
        """Reset the odometry to its origin."""
        self.reckoning.reset(worlds)
        if worlds is None:
            self.reckoning.restart()

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return odometry and time of the last update."""
        return {**self.reckoning.state(), "last_time": np.array(self.reckoning.last_ns)}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self.reckoning.restore(state)
        self.reckoning.last_ns = int(state["last_time"])


class TricycleSystem(OdometrySystem[TricycleDrive]):
    """Tricycles with wheels that drive, steer and count.

    Args:
        plugins: The tricycles.
    """

    def __init__(self, plugins: Sequence[TricycleDrive]) -> None:
        super().__init__(plugins)
        self._rolled = ReckoningGroup([each.reckoning for each in plugins])
        limits = [each.limits for each in plugins]
        self._radius = np.array([each.radius for each in limits])
        self._acceleration = np.array([each.acceleration for each in limits])
        self._deceleration = np.array([each.deceleration for each in limits])
        self._speed_tolerance = np.array([each.speed_tolerance for each in limits])
        self._steering_speed = np.array([each.steering_speed for each in limits])
        self._angle_tolerance = np.array([each.angle_tolerance for each in limits])
        self._steering = JointArray([each.joints[0] for each in plugins])
        self._wheels = JointArray([each.joints[1] for each in plugins])
        self._linear, self._angular = np.zeros((2, *self._rolled.tables.pose.shape))
        for part, each in enumerate(plugins):
            each.store_in(self._linear[:, part], self._angular[:, part])

    def update(self, time: float) -> None:  # noqa: ARG002  the clock knows it exactly
        """Count, drive and steer."""
        interval = self._rolled.interval()
        self._count()
        self._drive(interval)
        self._steer()

    def _count(self) -> None:
        """Start the next interval."""
        self._rolled.restart()

    def _drive(self, interval: Floats) -> None:
        target = self._linear[..., 0] / self._radius
        ramped = self._acceleration > 0.0
        if ramped.any():
            current = self._wheels.velocities()
            error = target - current
            most = np.where(error > 0.0, self._acceleration, self._deceleration) * interval
            near = np.abs(error) < self._speed_tolerance
            slow = np.where(near, current, current + np.clip(error, -most, most))
            target = np.where(ramped, slow, target)
        self._wheels.drive(target)

    def _steer(self) -> None:
        target = np.clip(self._angular[..., 2], -_MOST_ANGLE, _MOST_ANGLE)
        placed = self._steering_speed <= 0.0
        if placed.any():
            self._steering.place(target, 0.0, placed)
        if not placed.all():
            error = target - self._steering.positions()
            pace = np.where(np.abs(error) < self._angle_tolerance, 0.0, np.sign(error))
            self._steering.drive(pace * self._steering_speed, ~placed)


class EncoderTricycles(TricycleSystem):
    """Tricycles with odometry from their wheels."""

    def _count(self) -> None:
        """Add up what the wheels have rolled."""
        self._rolled.advance()
