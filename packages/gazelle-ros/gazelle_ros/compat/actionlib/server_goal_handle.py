"""Module under the path that actionlib uses."""

from gazelle_ros.actions.server import ServerGoalHandle

__all__ = ["ServerGoalHandle"]
