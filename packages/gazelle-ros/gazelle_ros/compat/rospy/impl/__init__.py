"""The few internals of rospy that scripts and tests reach for."""

from gazelle_ros.compat.rospy.impl import rosout, tcpros, tcpros_base, tcpros_service

__all__ = ["rosout", "tcpros", "tcpros_base", "tcpros_service"]
