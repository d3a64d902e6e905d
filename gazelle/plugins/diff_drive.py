"""Two driven wheels: what ``libgazebo_ros_diff_drive.so`` does.

Tags, defaults and rules are those of gazebo_ros_pkgs 2.9 (Noetic).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.description import Parameters, Pose
from gazelle.errors import SimulationError
from gazelle.plugins.frames import transform
from gazelle.plugins.odometry import POSE_VARIANCE, as_transforms, true_odometry
from gazelle.rotations import from_yaw
from gazelle.simulation import (
    JointStates,
    ModelPlugin,
    Odometry,
    Output,
    Robot,
    Transforms,
    TwistInput,
    absolute,
    namespace_of,
)

Floats = NDArray[np.float64]
Worlds = NDArray[np.intp]

# The ramp acts only while both wheels are farther than this from their target [m/s].
_RAMP_DEADBAND = 0.01


class DiffDrive(ModelPlugin):
    """Turns velocity commands into wheel speeds, and wheel or model motion into odometry.

    The last command holds for ever. With ``odometrySource`` ``world`` the odometry is the
    model's true pose; with ``encoder`` it is what the wheels' turning adds up to.
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, put motors on the wheels, open ``cmd_vel`` and ``odom``."""
        self._robot = robot
        self._separation = parameters.get("wheelSeparation", 0.34)
        self._radius = parameters.get("wheelDiameter", 0.15) / 2.0
        self._acceleration = parameters.get("wheelAcceleration", 0.0)
        self._frame = parameters.get("odometryFrame", "odom")
        self._base = parameters.get("robotBaseFrame", "base_footprint")
        self._from_encoders = _source(parameters) == "encoder"
        if self._separation <= 0.0 or self._radius <= 0.0:
            raise SimulationError(
                "wheelSeparation and wheelDiameter must be positive", source=parameters.source
            )
        self.update_rate = parameters.get("updateRate", 100.0)
        torque = parameters.get("wheelTorque", 5.0)
        names = [parameters.get("leftJoint", "left_joint")]
        names.append(parameters.get("rightJoint", "right_joint"))
        self._names = (names[0], names[1])
        self._wheels = tuple(robot.joints[name] for name in names)
        for wheel in self._wheels:
            wheel.add_motor(torque)
        nworld = robot.simulation.nworld
        self._speeds = np.zeros((nworld, 2))
        self._settled = -1  # the command whose speeds the motors already have
        self._encoder_pose = np.zeros((nworld, 3))
        self._encoder_twist = np.zeros((nworld, 2))
        self._last_angles = self._angles()
        self._last_time = robot.simulation.time
        self._open_ports(robot, parameters, nworld)

    def _open_ports(self, robot: Robot, parameters: Parameters, nworld: int) -> None:
        namespace = namespace_of(robot, parameters, robot.name)
        command = absolute(namespace, parameters.get("commandTopic", "cmd_vel"))
        self._command = robot.inputs["cmd_vel"] = TwistInput(nworld, command)
        topic = absolute(namespace, parameters.get("odometryTopic", "odom"))
        robot.outputs["odom"] = Output(topic, Odometry, self._measure)
        published = []
        if parameters.get("publishTf", True):
            published.append(robot.outputs["odom"])
            if parameters.get("publishOdomTF", True):
                robot.outputs["odom_tf"] = Output("/tf", Transforms, self._odometry_frame, namespace=namespace)
                published.append(robot.outputs["odom_tf"])
        if parameters.get("publishWheelTF", False):
            self._wheel_links = tuple(robot.joint_description(n).child for n in self._names)
            robot.outputs["wheel_tf"] = Output("/tf", Transforms, self._wheel_frames, namespace=namespace)
            published.append(robot.outputs["wheel_tf"])
        if parameters.get("publishWheelJointState", False):
            robot.outputs["joint_states"] = Output(
                absolute(namespace, "joint_states"), JointStates, self._read_wheels, queue_size=1000
            )
            published.append(robot.outputs["joint_states"])
        self._published = tuple(published)

    def on_update(self, time: float) -> None:
        """Drive the wheels and publish the odometry."""
        interval = time - self._last_time
        self._last_time = time
        if self._from_encoders:
            self._integrate_encoders(interval)
        self._drive(interval)
        for output in self._published:
            output.publish()

    def _drive(self, interval: float) -> None:
        if self._settled == self._command.revision:
            return
        forward, turning = self._command.linear[:, 0], self._command.angular[:, 2]
        half = self._separation / 2.0
        target = np.stack((forward - turning * half, forward + turning * half), axis=1)
        if self._acceleration > 0.0:
            lack = target - self._speeds
            ramping = (np.abs(lack) >= _RAMP_DEADBAND).all(axis=1, keepdims=True)
            most = self._acceleration * interval
            self._speeds = np.where(ramping, self._speeds + np.clip(lack, -most, most), target)
        else:
            self._speeds = target
        if (self._speeds == target).all():
            self._settled = self._command.revision
        for column, wheel in enumerate(self._wheels):
            wheel.drive(self._speeds[:, column] / self._radius)

    def _integrate_encoders(self, interval: float) -> None:
        """Dead reckoning with the heading at the middle of the interval."""
        angles = self._angles()
        left, right = (self._radius * (angles - self._last_angles)).T
        self._last_angles = angles
        if interval <= 0.0:
            return
        along, turned = (left + right) / 2.0, (right - left) / self._separation
        middle = self._encoder_pose[:, 2] + turned / 2.0
        self._encoder_pose[:, 0] += along * np.cos(middle)
        self._encoder_pose[:, 1] += along * np.sin(middle)
        self._encoder_pose[:, 2] += turned
        self._encoder_twist[:, 0] = along / interval
        self._encoder_twist[:, 1] = turned / interval

    def _angles(self) -> Floats:
        return np.concatenate([wheel.positions() for wheel in self._wheels], axis=1)

    def _measure(self) -> Odometry:
        if self._from_encoders:
            return self._from_wheels()
        return true_odometry(self._robot, self._frame, self._base)

    def _from_wheels(self) -> Odometry:
        zero = np.zeros(len(self._encoder_pose))
        x, y, yaw = self._encoder_pose.T
        # The original reports the length of the velocity, so it is never negative.
        speed, turning = np.abs(self._encoder_twist[:, 0]), self._encoder_twist[:, 1]
        return Odometry(
            self._robot.simulation.clock.now_ns,
            self._frame,
            self._base,
            np.stack((x, y, zero), axis=1),
            from_yaw(yaw),
            np.stack((speed, zero, zero), axis=1),
            np.stack((zero, zero, turning), axis=1),
            POSE_VARIANCE,
        )

    def _odometry_frame(self) -> Transforms:
        return as_transforms(self._measure())

    def _wheel_frames(self) -> Transforms:
        robot = self._robot
        base = robot.frame(self._base)
        frames = tuple(
            transform(base, (robot.links[wheel], Pose()), self._base, wheel)
            for wheel in self._wheel_links
        )
        return Transforms(robot.simulation.clock.now_ns, frames)

    def _read_wheels(self) -> JointStates:
        nothing = np.zeros((len(self._speeds), 0))
        now = self._robot.simulation.clock.now_ns
        return JointStates(now, self._names, self._angles(), nothing)

    def reset(self, worlds: Worlds | None) -> None:
        """Stand still at the origin of the odometry."""
        rows = slice(None) if worlds is None else worlds
        self._speeds[rows] = 0.0
        self._settled = -1
        self._encoder_pose[rows] = 0.0
        self._encoder_twist[rows] = 0.0
        self._last_angles[rows] = self._angles()[rows]
        if worlds is None:
            self._last_time = self._robot.simulation.time

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Wheel speeds, odometry and time of the last update."""
        return {
            "speeds": self._speeds.copy(),
            "encoder_pose": self._encoder_pose.copy(),
            "encoder_twist": self._encoder_twist.copy(),
            "last_angles": self._last_angles.copy(),
            "last_time": np.array(self._last_time),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        self._speeds[:] = state["speeds"]
        self._settled = -1
        self._encoder_pose[:] = state["encoder_pose"]
        self._encoder_twist[:] = state["encoder_twist"]
        self._last_angles[:] = state["last_angles"]
        self._last_time = float(state["last_time"])


def _source(parameters: Parameters) -> str:
    source = parameters.get("odometrySource", "world")
    words = {"0": "encoder", "1": "world"}
    if words.get(source, source) not in ("world", "encoder"):
        raise SimulationError(
            f"odometrySource must be world or encoder, not '{source}'", source=parameters.source
        )
    return words.get(source, source)
