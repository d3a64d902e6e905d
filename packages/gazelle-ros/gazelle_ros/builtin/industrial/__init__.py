"""Nodes of ROS-Industrial: a simulated robot controller, and the action of its trajectories."""
