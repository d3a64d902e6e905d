"""Nodes that make laser scans of clouds and depth images, and that filter scans."""
