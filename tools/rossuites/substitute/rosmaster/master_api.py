"""Attributes that roslaunch reads from this module."""

NUM_WORKERS = 3
