"""Mobile robots: motions and control loops for many at once, and navigation to a goal for one.

All on plain numbers, with neither ROS nor learning; only ``GoToGoal`` knows the simulation.
"""

from gazelle.navigation.agv import Limits, Motions, Outcome
from gazelle.navigation.grid import OccupancyGrid
from gazelle.navigation.limits import BaseLimits
from gazelle.navigation.pid import BoundedPid
from gazelle.navigation.plugin import GoToGoal
from gazelle.navigation.seeker import GoalSeeker
from gazelle.navigation.values import GoalPose, Path

__all__ = [
    "BaseLimits",
    "BoundedPid",
    "GoToGoal",
    "GoalPose",
    "GoalSeeker",
    "Limits",
    "Motions",
    "OccupancyGrid",
    "Outcome",
    "Path",
]
