"""What roslaunch asks of this module."""

NUM_WORKERS = 3
