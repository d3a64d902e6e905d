"""States that use the ROS graph, with the interface of executive_smach (ROS 1 Noetic)."""

from __future__ import annotations

from gazelle_ros.compat import rospy
from gazelle_ros.drop_in import smach
from gazelle_ros.drop_in.smach_ros.introspection import IntrospectionServer
from gazelle_ros.drop_in.smach_ros.service_state import ServiceState
from gazelle_ros.drop_in.smach_ros.simple_action_state import SimpleActionState
from gazelle_ros.drop_in.smach_ros.util import set_preempt_handler
from gazelle_ros.drop_in.smach_ros.waiting import ConditionState, MonitorState

smach.set_loggers(rospy.loginfo, rospy.logwarn, rospy.logdebug, rospy.logerr)
smach.set_shutdown_check(rospy.is_shutdown)

_HERE = "gazelle_ros.drop_in.smach_ros"
PLACES = {"condition_state": f"{_HERE}.waiting", "monitor_state": f"{_HERE}.waiting"}
"""From a module's name in smach_ros to the one that has what it had."""

__all__ = [
    "ConditionState",
    "IntrospectionServer",
    "MonitorState",
    "ServiceState",
    "SimpleActionState",
    "set_preempt_handler",
]
