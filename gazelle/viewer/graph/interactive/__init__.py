"""Interactive markers on the page of a graph."""

from gazelle.viewer.graph.interactive.servers import InteractiveServers

__all__ = ["InteractiveServers"]
