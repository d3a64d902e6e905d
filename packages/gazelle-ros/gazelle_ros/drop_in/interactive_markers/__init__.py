"""Markers that people move and click in a viewer, with the interface of ROS 1's ``interactive_markers``."""
