"""A running ROS graph on a page: robots, frames, and what topics carry."""

from gazelle.viewer.graph.view import GraphView

__all__ = ["GraphView"]
