"""Keyboard teleoperation: the nodes of turtlebot3_teleop and teleop_twist_keyboard."""
