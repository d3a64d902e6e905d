"""What stands between a robot's description and its frames: joints to transforms."""

from gazelle.ros.robot.joint_publisher import JointStatePublisher
from gazelle.ros.robot.state_publisher import RobotStatePublisher
from gazelle.ros.robot.tree import Joint, JointTree, read_joints

__all__ = [
    "Joint",
    "JointStatePublisher",
    "JointTree",
    "RobotStatePublisher",
    "read_joints",
]
