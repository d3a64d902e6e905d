"""The handler that logs to /rosout, where rospy keeps it."""

from gazelle_ros.compat.rospy.logs import RosOutHandler

__all__ = ["RosOutHandler"]
