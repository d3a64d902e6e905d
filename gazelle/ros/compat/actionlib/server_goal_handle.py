"""Module under the path that actionlib uses."""

from gazelle.ros.actions.server import ServerGoalHandle

__all__ = ["ServerGoalHandle"]
