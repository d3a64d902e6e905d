"""Panels of the page of a graph: what rqt's plugins do."""

from gazelle.viewer.graph.panels.panel_set import PanelSet

__all__ = ["PanelSet"]
