"""Fixtures of the ROS tests: a master, nodes, and built-in nodes as processes."""

from ros.conftest import listen, make_node, master, start  # noqa: F401  # pytest finds them here
