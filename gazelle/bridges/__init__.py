"""Doors: a simulation on a ROS 1 graph."""

from gazelle.bridges.serving import RosDoor, serve_ros

__all__ = ["RosDoor", "serve_ros"]
