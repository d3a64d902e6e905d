"""Panels of the page of a ROS graph, such as those of rqt."""

from gazelle.viewer.graph.panels.panel_set import PanelSet

__all__ = ["PanelSet"]
