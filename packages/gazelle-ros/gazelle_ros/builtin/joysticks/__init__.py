"""Joystick drivers, and nodes that turn joystick messages into commands."""
