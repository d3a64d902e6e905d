"""Four driven wheels, two on a side: what ``libgazebo_ros_skid_steer_drive.so`` does."""

from __future__ import annotations

from gazelle.description import Parameters
from gazelle.plugins.odometry import OdometryOutputs, TrueOdometry
from gazelle.plugins.wheels import Side, WheeledDrive
from gazelle.simulation import Robot, absolute, namespace_of

_CORNERS = (
    ("leftFrontJoint", "left_front_joint", Side.LEFT),
    ("rightFrontJoint", "right_front_joint", Side.RIGHT),
    ("leftRearJoint", "left_rear_joint", Side.LEFT),
    ("rightRearJoint", "right_rear_joint", Side.RIGHT),
)
_UNSURE = 1e12


class SkidSteerDrive(WheeledDrive):
    """Turns velocity commands into the speeds of four wheels; publishes the true odometry.

    The last command holds for ever.
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, put motors on the wheels, open ``cmd_vel`` and ``odom``."""
        self._robot = robot
        self.drive(
            robot,
            [(parameters.get(tag, name), side) for tag, name, side in _CORNERS],
            separation=parameters.get("wheelSeparation", 0.4),
            diameter=parameters.get("wheelDiameter", 0.15),
            torque=parameters.get("torque", 5.0),
            source=parameters.source,
        )
        self.update_rate = parameters.get("updateRate", 100.0)
        namespace = namespace_of(robot, parameters)
        self.listen(robot, absolute(namespace, parameters.get("commandTopic", "cmd_vel")))
        frame = parameters.get("odometryFrame", "odom")
        base = parameters.get("robotBaseFrame", "base_footprint")
        x, y, yaw = (
            parameters.get(f"covariance_{name}", default)
            for name, default in (("x", 0.0001), ("y", 0.0001), ("yaw", 0.01))
        )
        variance = (x, y, _UNSURE, _UNSURE, _UNSURE, yaw)
        measure = TrueOdometry(robot, frame, base, variance, variance)
        topic = absolute(namespace, parameters.get("odometryTopic", "odom"))
        framed = parameters.get("broadcastTF", False)
        self.publish_odometry(OdometryOutputs(robot, topic, measure, namespace, framed=framed))
