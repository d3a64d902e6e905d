"""Navigation of mobile robots: motion control for many robots at once, and driving to a goal.

The modules work on arrays, without ROS; only ``GoToGoal`` uses the simulation.
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
