"""Module under the path that actionlib uses."""

from gazelle.ros.actions.spec import ActionException

__all__ = ["ActionException"]
