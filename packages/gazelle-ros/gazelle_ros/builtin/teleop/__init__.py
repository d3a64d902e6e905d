"""Robots driven by keys in a terminal: the nodes of turtlebot3_teleop and teleop_twist_keyboard."""
