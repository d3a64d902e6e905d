"""Matrices, Euler angles and quaternions; see `gazelle_ros.transformations`."""

from gazelle_ros.transformations import *  # noqa: F403  # the same module by its name in ROS
from gazelle_ros.transformations.vectors import EPS as _EPS  # noqa: F401
