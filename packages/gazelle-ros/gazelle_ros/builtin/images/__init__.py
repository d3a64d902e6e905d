"""Nodes that convert images."""
