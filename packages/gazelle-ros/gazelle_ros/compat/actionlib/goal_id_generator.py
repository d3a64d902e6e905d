"""Names for goals that are unique."""

from __future__ import annotations

from typing import Any

from gazelle_ros.actions.spec import goal_id
from gazelle_ros.compat.rospy.state import process


class GoalIDGenerator:
    """Makes names.

    Args:
        name: Their beginning, by default the node's.
    """

    def __init__(self, name: str | None = None) -> None:
        self.name = name

    def set_name(self, name: str) -> None:
        """Set the prefix of names."""
        self.name = name

    def generate_ID(self) -> Any:  # noqa: N802  # actionlib's name
        """Return a new ``GoalID``."""
        return goal_id(process.require(), self.name)
