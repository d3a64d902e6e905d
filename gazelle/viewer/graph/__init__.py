"""A running ROS graph on a page: robots, frames, and messages of topics."""

from gazelle.viewer.graph.view import GraphView

__all__ = ["GraphView"]
