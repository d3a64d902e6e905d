"""Module under the path that actionlib uses."""

from gazelle_ros.actions.spec import ActionException

__all__ = ["ActionException"]
