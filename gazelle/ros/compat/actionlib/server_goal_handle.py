"""Where actionlib keeps it."""

from gazelle.ros.actions.server import ServerGoalHandle

__all__ = ["ServerGoalHandle"]
