"""Frames of a robot from its description: joint positions to transforms."""

from gazelle.ros.robot.joint_publisher import JointStatePublisher
from gazelle.ros.robot.state_publisher import RobotStatePublisher
from gazelle.ros.robot.tree import JointTree, TreeJoint, read_joints

__all__ = [
    "JointStatePublisher",
    "JointTree",
    "RobotStatePublisher",
    "TreeJoint",
    "read_joints",
]
