"""Types of an action, and names for goals."""

from __future__ import annotations

import itertools
import math
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

from gazelle_ros.base.deadlines import LONGEST_WAIT
from gazelle_ros.base.errors import RosError
from gazelle_ros.clock import SECOND
from gazelle_ros.messages import Message
from gazelle_ros.msgs import actionlib_msgs, std_msgs
from gazelle_ros.time import Duration, Time

if TYPE_CHECKING:
    from gazelle_ros.node import Node

_count = itertools.count(1)


class ActionException(RosError):  # noqa: N818  # actionlib's name
    """A class is no action."""


@dataclass(frozen=True)
class ActionTypes:
    """The message classes of an action.

    Attributes:
        action_goal: Goes to the server, with header and id; so do `action_result` and
            `action_feedback` come back.
        goal: Goal.
        result: Result.
        feedback: Feedback.
    """

    action_goal: Any
    action_result: Any
    action_feedback: Any
    goal: Any
    result: Any
    feedback: Any

    @classmethod
    def of(cls, spec: type[Message]) -> ActionTypes:
        """Return the types of an action class.

        It is for example ``control_msgs/FollowJointTrajectoryAction``.

        Raises:
            ActionException: The class is no action.
        """
        try:
            whole: Any = spec()
            parts = whole.action_goal, whole.action_result, whole.action_feedback
            inner = parts[0].goal, parts[1].result, parts[2].feedback
        except (AttributeError, TypeError):
            raise ActionException(f"Type is not an action spec: {spec}") from None
        return cls(*(type(part) for part in parts), *(type(part) for part in inner))


class Now(Protocol):
    """Clock of an action server."""

    def now(self) -> int:
        """Return the time [ns]."""


def now(clock: Now) -> Time:
    """Return a clock's time."""
    stamp = clock.now()
    return Time(stamp // SECOND, stamp % SECOND)


def goal_id(
    node: Node, name: str | None = None, clock: Now | None = None
) -> actionlib_msgs.msg.GoalID:
    """Return a unique ``GoalID``; its name and time are the node's if not given."""
    stamp = now(clock or node.clock)
    made = actionlib_msgs.msg.GoalID()
    made.stamp = stamp
    made.id = f"{name or node.name}-{next(_count)}-{stamp.secs}.{stamp.nsecs}"
    return made


def header(clock: Now) -> std_msgs.msg.Header:
    """Return a ``Header`` with a clock's time."""
    made = std_msgs.msg.Header()
    made.stamp = now(clock)
    return made


def wait(
    node: Node,
    condition: threading.Condition,
    done: Callable[[], bool],
    timeout: Duration | float | None,
) -> bool:
    """Wait for something that a condition announces.

    Args:
        node: Node whose time counts, and whose end ends the wait.
        condition: Is held while `done` is called.
        done: Whether the wait is over.
        timeout: The longest wait, a duration or seconds; 0 or None for ever.

    Returns:
        Whether it came true.

    Raises:
        RosError: The timeout is not a number.
    """
    seconds = timeout.to_sec() if isinstance(timeout, Duration) else timeout or 0.0
    limit = min(seconds, LONGEST_WAIT) * SECOND
    if math.isnan(limit):
        raise RosError("a timeout must be a number, not nan")
    begin = node.clock.now()
    with condition:
        while not done():
            if node.closed or (limit > 0 and node.clock.now() - begin >= limit):
                return False
            condition.wait(0.05)
    return True
