"""Built-in nodes that replace those of common ROS packages."""

from gazelle_ros.builtin.package import BuiltinPackage
from gazelle_ros.builtin.registry import register

__all__ = ["BuiltinPackage", "register"]
