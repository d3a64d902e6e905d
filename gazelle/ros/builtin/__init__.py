"""Nodes that come with Gazelle, in place of those of well-known ROS packages."""

from gazelle.ros.builtin.package import BuiltinPackage
from gazelle.ros.builtin.registry import register

__all__ = ["BuiltinPackage", "register"]
