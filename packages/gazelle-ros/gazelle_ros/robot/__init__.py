"""Frames of a robot from its description: joint positions to transforms."""

from gazelle_ros.robot.joint_publisher import JointStatePublisher
from gazelle_ros.robot.state_publisher import RobotStatePublisher
from gazelle_ros.robot.tree import JointTree, TreeJoint, read_joints

__all__ = [
    "JointStatePublisher",
    "JointTree",
    "RobotStatePublisher",
    "TreeJoint",
    "read_joints",
]
