"""Matrices, Euler angles and quaternions; see `gazelle.ros.transformations`."""

from gazelle.ros.transformations import *  # noqa: F403  # the same module by its name in ROS
from gazelle.ros.transformations.vectors import EPS as _EPS  # noqa: F401
