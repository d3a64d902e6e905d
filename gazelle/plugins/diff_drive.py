"""Two driven wheels: what ``libgazebo_ros_diff_drive.so`` does.

Tags, defaults and rules are those of gazebo_ros_pkgs 2.9 (Noetic).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.plugins.dead_reckoning import DeadReckoning
from gazelle.plugins.frames import frames_output, joint_transforms
from gazelle.plugins.odometry import POSE_VARIANCE, OdometryOutputs, true_odometry
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

# The ramp acts only while both wheels are farther than this from their target [m/s].
_RAMP_DEADBAND = 0.01


class DiffDrive(ModelPlugin):
    """Turns velocity commands into wheel speeds, and wheel or model motion into odometry.

    The last command holds for ever. With ``odometrySource`` ``world`` the odometry is the
    model's true pose; with ``encoder`` it is what the wheels' turning adds up to.

    Attributes:
        separation: Between the wheels [m].
        radius: Of a wheel [m].
        acceleration: Most change of a wheel's speed on the ground [m/s²]; 0 for no limit.
        wheel_joints: Names of the left and the right joint, as the file has them.
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, put motors on the wheels, open ``cmd_vel`` and ``odom``."""
        self._robot = robot
        self.separation = parameters.get("wheelSeparation", 0.34)
        self.radius = parameters.get("wheelDiameter", 0.15) / 2.0
        self.acceleration = parameters.get("wheelAcceleration", 0.0)
        self._frame = parameters.get("odometryFrame", "odom")
        self._base = parameters.get("robotBaseFrame", "base_footprint")
        self._from_encoders = _source(parameters) == "encoder"
        if self.separation <= 0.0 or self.radius <= 0.0:
            raise SimulationError(
                "wheelSeparation and wheelDiameter must be positive", source=parameters.source
            )
        self.update_rate = parameters.get("updateRate", 100.0)
        if "left_joint" in parameters and "leftJoint" not in parameters:
            raise SimulationError(
                "it has the tags of ROS 2 (<left_joint>)",
                source=parameters.source,
                hint="ROS 1's are <leftJoint>, <wheelSeparation> and so on",
            )
        torque = parameters.get("wheelTorque", 5.0)
        names = [parameters.get("leftJoint", "left_joint")]
        names.append(parameters.get("rightJoint", "right_joint"))
        self.wheel_joints = (names[0], names[1])
        self._wheels = tuple(robot.joints[name] for name in names)
        for wheel in self._wheels:
            wheel.add_motor(torque)
        nworld = robot.simulation.nworld
        self._speeds = np.zeros((nworld, 2))
        self._settled = -1  # the command whose speeds the motors already have
        self._reckoning = DeadReckoning(self.separation, self.radius, self._angles())
        self._watch = Stopwatch(robot.simulation.clock)
        self._open_ports(robot, parameters, nworld)

    def _open_ports(self, robot: Robot, parameters: Parameters, nworld: int) -> None:
        namespace = namespace_of(robot, parameters, robot.name)
        command = absolute(namespace, parameters.get("commandTopic", "cmd_vel"))
        self._command = robot.inputs["cmd_vel"] = TwistInput(nworld, command)
        topic = absolute(namespace, parameters.get("odometryTopic", "odom"))
        published: list[Published] = []
        sent = parameters.get("publishTf", True)
        framed = sent and parameters.get("publishOdomTF", True)
        odometry = OdometryOutputs(robot, topic, self._measure, namespace, framed=framed)
        if sent:
            published.append(odometry)
        if parameters.get("publishWheelTF", False):
            self._wheel_joints = [robot.joint_description(name) for name in self.wheel_joints[::-1]]
            robot.outputs["wheel_tf"] = frames_output(self._wheel_frames, namespace)
            published.append(robot.outputs["wheel_tf"])
        if parameters.get("publishWheelJointState", False):
            robot.outputs["joint_states"] = Output(
                absolute(namespace, "joint_states"), JointStates, self._read_wheels, queue_size=1000
            )
            published.append(robot.outputs["joint_states"])
        self._published = tuple(published)

    def on_update(self, time: float) -> None:  # noqa: ARG002  the watch tells
        """Drive the wheels and publish the odometry."""
        interval = self._watch.lap()
        if self._from_encoders:
            self._reckoning.advance(self._angles(), interval)
        self._drive(interval)
        for output in self._published:
            output.publish()

    def _drive(self, interval: float) -> None:
        if self._settled == self._command.revision:
            return
        forward, turning = self._command.linear[:, 0], self._command.angular[:, 2]
        half = self.separation / 2.0
        target = np.stack((forward - turning * half, forward + turning * half), axis=1)
        if self.acceleration > 0.0:
            lack = target - self._speeds
            ramping = (np.abs(lack) >= _RAMP_DEADBAND).all(axis=1, keepdims=True)
            most = self.acceleration * interval
            self._speeds = np.where(ramping, self._speeds + np.clip(lack, -most, most), target)
        else:
            self._speeds = target
        if (self._speeds == target).all():
            self._settled = self._command.revision
        for column, wheel in enumerate(self._wheels):
            wheel.drive(self._speeds[:, column] / self.radius)

    def _angles(self) -> Floats:
        return np.concatenate([wheel.positions() for wheel in self._wheels], axis=1)

    def _measure(self) -> Odometry:
        if self._from_encoders:
            return self._from_wheels()
        return true_odometry(self._robot, self._frame, self._base)

    def _from_wheels(self) -> Odometry:
        now = self._robot.simulation.clock.now_ns
        found = self._reckoning.odometry(now, self._frame, self._base, POSE_VARIANCE)
        # The original reports the length of the velocity, so it is never negative.
        return replace(found, linear=np.abs(found.linear))

    def _wheel_frames(self) -> Transforms:
        return joint_transforms(self._robot, self._wheel_joints)

    def _read_wheels(self) -> JointStates:
        nothing = np.zeros((len(self._speeds), 0))
        now = self._robot.simulation.clock.now_ns
        # The original names the right wheel first.
        return JointStates(now, self.wheel_joints[::-1], self._angles()[:, ::-1], nothing)

    def reset(self, worlds: Worlds | None) -> None:
        """Stand still at the origin of the odometry."""
        rows = slice(None) if worlds is None else worlds
        self._speeds[rows] = 0.0
        self._settled = -1
        self._reckoning.reset(worlds, self._angles())
        if worlds is None:
            self._watch.restart()

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Wheel speeds, odometry and time of the last update."""
        rolled = {f"encoder_{name}": value for name, value in self._reckoning.state().items()}
        last_time = np.array(self._watch.start_ns)
        return {"speeds": self._speeds.copy(), **rolled, "last_time": last_time}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        self._speeds[:] = state["speeds"]
        self._settled = -1
        self._reckoning.restore({n: state[f"encoder_{n}"] for n in ("pose", "twist", "angles")})
        self._watch.start_ns = int(state["last_time"])


def _source(parameters: Parameters) -> str:
    source = parameters.get("odometrySource", "world")
    words = {"0": "encoder", "1": "world"}
    if words.get(source, source) not in ("world", "encoder"):
        raise SimulationError(
            f"odometrySource must be world or encoder, not '{source}'", source=parameters.source
        )
    return words.get(source, source)
