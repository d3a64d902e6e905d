"""Responses of services and results of actions that have a ``moveit_msgs/MoveItErrorCodes``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol, TypeVar

from gazelle_ros.msgs import moveit_msgs


class WithErrorCode(Protocol):
    """Message with an error code."""

    error_code: moveit_msgs.msg.MoveItErrorCodes


if TYPE_CHECKING:
    ActionResult = (
        moveit_msgs.msg.ExecuteTrajectoryResult
        | moveit_msgs.msg.MoveGroupResult
        | moveit_msgs.msg.PickupResult
        | moveit_msgs.msg.PlaceResult
    )

WithErrorCodeT = TypeVar("WithErrorCodeT", bound=WithErrorCode)
