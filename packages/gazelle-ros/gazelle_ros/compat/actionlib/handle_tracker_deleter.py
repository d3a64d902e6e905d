"""Notes when the last handle of a goal is gone; Gazelle's own servers do not need it."""

from __future__ import annotations

from typing import Any

from gazelle_ros.actions.spec import now
from gazelle_ros.compat.rospy.state import process


class HandleTrackerDeleter:
    """Notes when the last handle of a goal is gone.

    Args:
        action_server: Server of the goal; its lock is taken.
        status_tracker: Of the goal.
    """

    def __init__(self, action_server: Any, status_tracker: Any) -> None:
        self.action_server = action_server
        self.status_tracker = status_tracker

    def __call__(self, ptr: Any) -> None:
        """Record the time; the handle itself does not matter."""
        del ptr
        if self.action_server:
            with self.action_server.lock:
                self.status_tracker.handle_destruction_time = now(process.require().clock)
