"""Two driven wheels: what ``libgazebo_ros_diff_drive.so`` does.

Tags, defaults and rules are those of gazebo_ros_pkgs 2.9 (Noetic).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

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
from gazelle.plugins.wheel_motors import WheelMotors, WheelSystem, wheel_law
from gazelle.simulation import (
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


class DiffDrive(ModelPlugin):
    """Turns velocity commands into wheel speeds, and wheel or model motion into odometry.

    The last command holds for ever. With ``odometrySource`` ``world`` the odometry is the
    model's true pose; with ``encoder`` it is what the wheels' turning adds up to.

    Attributes:
        separation: Between the wheels [m].
        radius: Of a wheel [m].
        acceleration: Most change of a wheel's speed on the ground [m/s²]; 0 for no limit.
        wheel_joints: Names of the left and the right joint, as the file has them.
        motors: Of the wheels.
        reckoning: Of how far the wheels have rolled.
        from_encoders: Whether the odometry is that.
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, put motors on the wheels, open ``cmd_vel`` and ``odom``."""
        self._robot = robot
        self.separation = parameters.get("wheelSeparation", 0.34)
        self.radius = parameters.get("wheelDiameter", 0.15) / 2.0
        self.acceleration = parameters.get("wheelAcceleration", 0.0)
        self.from_encoders = _source(parameters) == "encoder"
        self.system = EncoderDrives if self.from_encoders else WheelSystem
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
        self.reckoning = DeadReckoning(
            robot.simulation.clock, self.separation, self.radius, self._wheels
        )
        self._open_ports(robot, parameters, robot.simulation.nworld)
        self.motors = WheelMotors(
            robot,
            self._command,
            self._wheels[:1],
            self._wheels[1:],
            separation=self.separation,
            radius=self.radius,
            acceleration=self.acceleration,
        )

    def _open_ports(self, robot: Robot, parameters: Parameters, nworld: int) -> None:
        namespace = namespace_of(robot, parameters, robot.name)
        command = absolute(namespace, parameters.get("commandTopic", "cmd_vel"))
        self._command = robot.inputs["cmd_vel"] = TwistInput(nworld, command)
        topic = absolute(namespace, parameters.get("odometryTopic", "odom"))
        published: list[Published] = []
        sent = parameters.get("publishTf", True)
        framed = sent and parameters.get("publishOdomTF", True)
        measure = self._odometry_source(parameters)
        self.odometry = OdometryOutputs(robot, topic, measure, namespace, framed=framed)
        if sent:
            published.append(self.odometry)
        if parameters.get("publishWheelTF", False):
            self._wheel_joints = [robot.joint_description(name) for name in self.wheel_joints[::-1]]
            robot.outputs["wheel_tf"] = frames_output(self._wheel_frames, namespace)
            published.append(robot.outputs["wheel_tf"])
        if parameters.get("publishWheelJointState", False):
            robot.outputs["joint_states"] = Output(
                absolute(namespace, "joint_states"), JointStates, self._read_wheels, queue_size=1000
            )
            published.append(robot.outputs["joint_states"])
        self.published = tuple(published)

    def _angles(self) -> Floats:
        return np.concatenate([wheel.positions() for wheel in self._wheels], axis=1)

    def _odometry_source(self, parameters: Parameters) -> OdometrySource:
        frame = parameters.get("odometryFrame", "odom")
        base = parameters.get("robotBaseFrame", "base_footprint")
        if not self.from_encoders:
            return TrueOdometry(self._robot, frame, base)
        # The original reports the length of the velocity, so it is never negative.
        return RolledOdometry(self.reckoning, frame, base, POSE_VARIANCE, signed=False)

    def _wheel_frames(self) -> Transforms:
        return joint_transforms(self._robot, self._wheel_joints)

    def _read_wheels(self) -> JointStates:
        nothing = np.zeros((self._robot.simulation.nworld, 0))
        now = self._robot.simulation.clock.now_ns
        # The original names the right wheel first.
        return JointStates(now, self.wheel_joints[::-1], self._angles()[:, ::-1], nothing)

    def reset(self, worlds: Worlds | None) -> None:
        """Reset the odometry to its origin, at rest."""
        rows = slice(None) if worlds is None else worlds
        tables = self.motors.tables
        tables.speeds[:, 0][rows] = 0.0
        self.motors.forget(worlds)
        if self.from_encoders:
            self.reckoning.reset(worlds)
        if worlds is None:
            self.reckoning.restart()
            tables.last_ns[:, 0][:] = self.reckoning.last_ns

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return wheel speeds, odometry and times of the last update."""
        rolled = {f"encoder_{name}": value for name, value in self.reckoning.state().items()}
        tables = self.motors.tables
        times = {
            "last_ns": tables.last_ns[:, 0].copy(),
            "reckoned_ns": np.array(self.reckoning.last_ns),
        }
        return {"speeds": tables.speeds[:, 0].copy(), **rolled, **times}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        tables = self.motors.tables
        tables.speeds[:, 0][:], tables.last_ns[:, 0][:] = state["speeds"], state["last_ns"]
        self.motors.forget(None)  # the motors are given their speeds again
        self.reckoning.restore({n: state[f"encoder_{n}"] for n in ("pose", "twist", "angles")})
        self.reckoning.last_ns = int(state["reckoned_ns"])


class EncoderDrives(OdometrySystem[DiffDrive]):
    """Drives that count the turns of their wheels.

    Args:
        plugins: The drives.
    """

    def __init__(self, plugins: Sequence[DiffDrive]) -> None:
        super().__init__(plugins)
        self._rolled = ReckoningGroup([each.reckoning for each in plugins])
        self._law = wheel_law([each.motors for each in plugins])
        simulation = plugins[0].motors.robot.simulation
        self._clock, self._rows = simulation.clock, simulation.nworld * len(plugins)

    def update(self, time: float) -> None:  # noqa: ARG002  the clock knows it exactly
        """Count and drive."""
        self._rolled.advance()
        self._law.update_from_python(0, self._rows, self._clock.now_ns)


def _source(parameters: Parameters) -> str:
    source = parameters.get("odometrySource", "world")
    words = {"0": "encoder", "1": "world"}
    if words.get(source, source) not in ("world", "encoder"):
        raise SimulationError(
            f"odometrySource must be world or encoder, not '{source}'", source=parameters.source
        )
    return words.get(source, source)
