"""Nodes that come with Gazelle, in place of those of well-known ROS packages."""

from gazelle_ros.builtin.package import BuiltinPackage
from gazelle_ros.builtin.registry import register

__all__ = ["BuiltinPackage", "register"]
