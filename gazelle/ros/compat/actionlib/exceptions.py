"""Where actionlib keeps it."""

from gazelle.ros.actions.spec import ActionException

__all__ = ["ActionException"]
