"""Mobile robots: go to a goal over unknown ground, around what a laser sees.

It knows neither ROS nor learning; ``GoalSeeker`` knows not even the simulation.
"""

from gazelle.navigation.grid import OccupancyGrid
from gazelle.navigation.limits import Limits
from gazelle.navigation.plugin import GoToGoal
from gazelle.navigation.seeker import GoalSeeker
from gazelle.navigation.values import GoalPose, Path

__all__ = ["GoToGoal", "GoalPose", "GoalSeeker", "Limits", "OccupancyGrid", "Path"]
