"""A constant, where rospy keeps it."""

from gazelle_ros.compat.rospy.topics import DEFAULT_BUFF_SIZE

__all__ = ["DEFAULT_BUFF_SIZE"]
