"""Doors: a simulation on a ROS 1 graph."""

from gazelle.bridges.serving import RosDoor, refuse_twin, serve_ros

__all__ = ["RosDoor", "refuse_twin", "serve_ros"]
