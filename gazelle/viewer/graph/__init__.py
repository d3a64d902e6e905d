"""The web page of a ROS graph: displays of robots, frames and topics, and panels."""

from gazelle.viewer.graph.view import GraphView

__all__ = ["GraphView"]
