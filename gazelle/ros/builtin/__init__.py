"""Nodes that come with Gazelle, in place of those of well-known ROS packages."""

from gazelle.ros.builtin.registry import BuiltinPackage, register

__all__ = ["BuiltinPackage", "register"]
