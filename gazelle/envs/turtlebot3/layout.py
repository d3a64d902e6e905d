"""Starts and goals of a TurtleBot3 task: as published, or anywhere in free space."""

from __future__ import annotations

import dataclasses
import functools
import warnings

import numpy as np

from gazelle.array_types import Floats
from gazelle.envs.floor_plan import FloorPlan
from gazelle.envs.free_space import FreeSpace, floor_plan_of
from gazelle.envs.goals import GoalTable
from gazelle.envs.options import NavigationSettings
from gazelle.envs.starts import RandomStarts
from gazelle.envs.turtlebot3.rules import STAGES, stage_goals
from gazelle.envs.turtlebot3.scene import TaskScene
from gazelle.errors import Error, GazelleWarning, TaskError
from gazelle.sensors import LidarModel

_START_MARGIN, _GOAL_MARGIN = 0.4, 0.3  # from all that stands [m]
_APART = 0.5  # of a goal from the one before, and of the first one from a fixed start [m]
_UNSEEN = 0.2  # of held-out goals from those seen in training, where these leave the room [m]


class GoalLayout:
    """Goals and starts of the settings.

    Places in free space are on a square lattice: those for training on its points, held-out
    ones in the middles of its squares, so that no policy was trained on one.

    Args:
        stage: 1 to 4.
        settings: Options of the user.
    """

    def __init__(self, stage: int, settings: NavigationSettings) -> None:
        self._stage = stage
        self._settings = settings

    def goals(self) -> GoalTable:
        """Return the places of goals, and which may follow which.

        Raises:
            TaskError: The user's goals are no places, or no place is free.
        """
        chosen, fixed = self._settings.goals, self._settings.starts == "published"
        if chosen is None or chosen == "published":
            return stage_goals(self._stage)
        if not isinstance(chosen, str):
            return GoalTable(chosen)
        places = self.space.places(_GOAL_MARGIN, between=chosen == "held-out")
        if chosen == "held-out":
            places = _unseen(places, stage_goals(self._stage).points)
            if self._settings.seen_goals is not None:
                places = _unseen(places, GoalTable(self._settings.seen_goals).points)
        if fixed:
            places = places[np.hypot(*(places - self._start).T) > _APART]
        if not len(places):
            raise TaskError(
                "there is no free place for a goal", hint="give goals of your own, with goals=..."
            )
        away = np.hypot(*np.moveaxis(places[:, None, :] - places[None, :, :], 2, 0)) > _APART
        return GoalTable(places, away)

    @property
    def has_free_goals(self) -> bool:
        """True if goals are drawn from free space, not from a list."""
        return self._settings.goals in ("training", "held-out")

    def starts(self, nworld: int) -> RandomStarts | None:
        """Return the starts of the robot; None if always the stage's own."""
        chosen = self._settings.starts
        if chosen == "published":
            return None
        places = self.space.places(_START_MARGIN, between=chosen == "held-out")
        return RandomStarts(places, nworld)

    @functools.cached_property
    def plan(self) -> FloorPlan:
        """Obstacles of the world, seen from above.

        Raises:
            TaskError: The world or the robot cannot be laid in the plane.
        """
        flat = dataclasses.replace(self._settings, engine="planar", threads=1, time_step=None)
        try:
            with warnings.catch_warnings():
                # What there is to report was reported when the task's own scene was made.
                warnings.simplefilter("ignore", GazelleWarning)
                scene = TaskScene(STAGES[self._stage], flat, 1)
        except Error as error:
            raise TaskError(
                f"free space cannot be computed in the plane: {error}",
                hint='goals and starts as published (goals="published", starts="published") '
                "need no free space",
            ) from error
        with scene.simulation:
            model = scene.robot.sensors[scene.lidar.sensor].model
            if not isinstance(model, LidarModel):
                raise TaskError("the sensor of this task must be a lidar")
            link = scene.simulation.engine.links[model.link].placement(None)
            height = float(link.position[0, 2] + model.origins[:, 2].max())
            return floor_plan_of(scene.robot, height)

    @functools.cached_property
    def space(self) -> FreeSpace:
        """Space that the robot can reach from the stage's start."""
        return FreeSpace(self.plan, self._start)

    @property
    def _start(self) -> tuple[float, float]:
        return STAGES[self._stage].start


def _unseen(places: Floats, seen: Floats) -> Floats:
    """Return the places away from others: at most half as far as these are from each other.

    So a list that lies close, such as a grid, leaves what is between its points.
    """
    apart = np.hypot(*np.moveaxis(seen[:, None, :] - seen[None, :, :], 2, 0))
    np.fill_diagonal(apart, np.inf)
    least = min(_UNSEEN, 0.5 * float(apart.min()))
    nearest = np.hypot(*np.moveaxis(places[:, None, :] - seen[None, :, :], 2, 0)).min(axis=1)
    kept: Floats = places[nearest > least]
    return kept
