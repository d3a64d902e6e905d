"""Choice of the next goal in an unknown world, as ``explore_lite`` does."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from gazelle.errors import Error
from gazelle.navigation.frontiers import Frontier
from gazelle_ros.base.parameter_values import Values, fields_of

_SAME_CELLS = 5
"""Goals that are nearer than this to one that was given up are given up, too."""

Place = tuple[float, float]


@dataclass(frozen=True, slots=True)
class ExploreSettings:
    """Names and defaults are those of ``explore_lite``.

    Attributes:
        planner_frequency: Rate of planning [Hz].
        progress_timeout: A goal that comes no nearer for so long is given up [s].
        potential_scale: Cost of a metre to a frontier.
        orientation_scale: Without effect, as in the original.
        gain_scale: Value of a metre of a frontier.
        min_frontier_size: Shorter frontiers do not count [m].
    """

    planner_frequency: float = 1.0
    progress_timeout: float = 30.0
    potential_scale: float = 1e-3
    orientation_scale: float = 0.0
    gain_scale: float = 1.0
    min_frontier_size: float = 0.5

    @classmethod
    def read(cls, values: Values) -> ExploreSettings:
        """Read the parameters.

        Raises:
            Error: One is of the wrong kind, or it would never look.
        """
        settings = cls(**fields_of(cls, values))
        if not settings.planner_frequency > 0.0:
            raise Error("'planner_frequency' must be greater than zero")
        return settings


@dataclass(frozen=True, slots=True)
class NextGoal:
    """Next goal of the exploration.

    Attributes:
        place: Next place (x, y) [m]; None if there is nothing left to explore.
        fresh: Whether that is another place than before.
    """

    place: Place | None
    fresh: bool = False


class Explorer:
    """Goes for the frontier that is worth most, until none is left.

    Args:
        settings: Weights.
        resolution: Of the map: side of a cell [m].
    """

    def __init__(self, settings: ExploreSettings, resolution: float) -> None:
        self.settings = settings
        self._near = _SAME_CELLS * resolution
        self._resolution = resolution
        self.given_up: list[Place] = []
        self._goal: Place | None = None
        self._distance = math.inf
        self._progress = 0.0

    def cost(self, frontier: Frontier) -> float:
        """Return the cost of a frontier; as in the original, in cells times their side twice."""
        s, side = self.settings, self._resolution
        return side * (s.potential_scale * frontier.distance - s.gain_scale * frontier.size)

    def is_given_up(self, place: Place) -> bool:
        """Return whether a place is close to one that was given up."""
        return any(
            abs(place[0] - x) < self._near and abs(place[1] - y) < self._near
            for x, y in self.given_up
        )

    def give_up(self, place: Place) -> None:
        """Exclude an unreachable place from now on."""
        self.given_up.append(place)

    def decide(self, time: float, frontiers: Sequence[Frontier]) -> NextGoal:
        """Choose the next goal.

        Args:
            time: Now [s].
            frontiers: All there are.
        """
        left = sorted(
            (each for each in frontiers if not self.is_given_up(each.centroid)), key=self.cost
        )
        for best in left:
            fresh = best.centroid != self._goal
            if fresh or best.distance < self._distance:
                self._progress, self._distance = time, best.distance
            self._goal = best.centroid
            if time - self._progress <= self.settings.progress_timeout:
                return NextGoal(best.centroid, fresh)
            self.give_up(best.centroid)
        self._goal = None
        return NextGoal(None)
