"""Outcomes of planning requests; the numbers are those of moveit_msgs/MoveItErrorCodes."""

from __future__ import annotations

from enum import IntEnum

from gazelle.errors import PlanningError


class PlanOutcome(IntEnum):
    """Outcome of a planning request."""

    SUCCESS = 1
    FAILURE = 99999
    PLANNING_FAILED = -1
    INVALID_MOTION_PLAN = -2
    MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE = -3
    CONTROL_FAILED = -4
    TIMED_OUT = -6
    PREEMPTED = -7
    START_STATE_IN_COLLISION = -10
    START_STATE_VIOLATES_PATH_CONSTRAINTS = -11
    GOAL_IN_COLLISION = -12
    GOAL_VIOLATES_PATH_CONSTRAINTS = -13
    GOAL_CONSTRAINTS_VIOLATED = -14
    INVALID_GROUP_NAME = -15
    INVALID_GOAL_CONSTRAINTS = -16
    INVALID_ROBOT_STATE = -17
    INVALID_LINK_NAME = -18
    INVALID_OBJECT_NAME = -19
    FRAME_TRANSFORM_FAILURE = -21
    START_STATE_INVALID = -26
    GOAL_STATE_INVALID = -27
    NO_IK_SOLUTION = -31


class NoPlanError(PlanningError):
    """There is no plan.

    Attributes:
        outcome: Reason.
    """

    def __init__(self, message: str, outcome: PlanOutcome, hint: str | None = None) -> None:
        super().__init__(message, hint=hint)
        self.outcome = outcome
