"""Keeps how a goal stands; Gazelle's own servers keep it in the goal's handle."""

from __future__ import annotations

from typing import Any

from gazelle_ros.actions.spec import now
from gazelle_ros.compat.actionlib.goal_id_generator import GoalIDGenerator
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.msgs import actionlib_msgs
from gazelle_ros.time import Time


class StatusTracker:
    """Status of a goal.

    Args:
        goal_id: Goal's id; with `status`.
        status: Status, a constant of ``GoalStatus``.
        goal: The goal itself, instead of the other two; one without an id gets one.
    """

    def __init__(self, goal_id: Any = None, status: Any = None, goal: Any = None) -> None:
        self.handle_tracker: Any = None
        self.handle_destruction_time = Time()
        self.id_generator = GoalIDGenerator()
        self.goal = None if goal_id else goal
        self.status: Any
        self.status = actionlib_msgs.msg.GoalStatus()
        if goal_id:
            self.status.goal_id, self.status.status = goal_id, status
            return
        self.status.goal_id = goal.goal_id
        if not self.status.goal_id.id:
            self.status.goal_id = self.id_generator.generate_ID()
        if not self.status.goal_id.stamp:
            self.status.goal_id.stamp = now(process.require().clock)
