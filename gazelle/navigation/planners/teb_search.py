"""Search for the best timed elastic band: those of the last cycle, and new ones of other classes."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np

from gazelle.array_types import Floats
from gazelle.navigation.angles import wrapped
from gazelle.navigation.following import Pose2
from gazelle.navigation.planners.teb_band import first_band, maneuvers, moved_on, optimised
from gazelle.navigation.planners.teb_classes import PassedObstacles, PathClass, paths_of_classes
from gazelle.navigation.planners.teb_cost import Band, BandCost
from gazelle.navigation.planners.teb_settings import TebSettings


@dataclass(frozen=True, slots=True)
class BandTask:
    """Input of a search.

    Attributes:
        pose: Of the robot.
        plan: Poses to the goal, shape (n, 3).
        cost: Of bands.
        gap: Obstacles less than twice this apart are one [m].
        whole: Whether the plan ends at the goal of the robot.
        feasible: Tests whether a band hits nothing at its begin.
    """

    pose: Pose2
    plan: Floats
    cost: BandCost
    gap: float
    whole: bool
    feasible: Callable[[Band], bool]

    @property
    def goal(self) -> Pose2:
        """End of the plan."""
        x, y, heading = self.plan[-1].tolist()
        return x, y, heading


class BandSearch:
    """Optimises a band of each homotopy class, and chooses among them.

    Args:
        settings: Of the planner.
        period: Between two cycles [s].
    """

    def __init__(self, settings: TebSettings, period: float) -> None:
        self._settings, self._period = settings, period
        self._rng = np.random.default_rng(0)
        self._bands: list[Band] = []
        self._since_switch = math.inf

    def configure(self, settings: TebSettings) -> None:
        """Apply new settings while running."""
        self._settings = settings

    @property
    def bands(self) -> list[Band]:
        """Bands of the last cycle, the chosen one first."""
        return self._bands

    def next(self, task: BandTask, *, stalled: bool) -> Band | None:
        """Return the best band; None if there is none that hits nothing.

        Args:
            task: Input of this cycle.
            stalled: Whether to begin again, because the last bands ended in a stand.
        """
        self._since_switch += self._period
        kept = [] if stalled else self._kept(task)
        chosen = self._chosen(task, kept, [], stays=True) if kept else None
        if chosen is None:
            chosen = self._chosen(task, [], self._begun(task, stalled=stalled), stays=False)
        return chosen

    def _kept(self, task: BandTask) -> list[Band]:
        """Return bands of the last cycle from where the robot is now, unless the goal is another one."""
        s, goal = self._settings, task.goal
        if not self._bands:
            return []
        x, y, heading = self._bands[0].poses[-1]
        if (
            math.hypot(goal[0] - x, goal[1] - y) >= s.force_reinit_new_goal_dist
            or abs(wrapped(goal[2] - heading)) >= s.force_reinit_new_goal_angular
        ):
            return []
        return [moved_on(each, task.pose, goal) for each in self._bands if len(each.poses) > 2]

    def _begun(self, task: BandTask, *, stalled: bool) -> list[Band]:
        begun = [first_band(task.plan, task.pose, self._settings)]
        if self._settings.min_turning_radius > 0.0 and (task.whole or stalled):
            begun += maneuvers(task.pose, task.goal, self._settings)
        return begun

    def _chosen(
        self, task: BandTask, kept: list[Band], begun: list[Band], *, stays: bool
    ) -> Band | None:
        """Return the best of some bands, and keep all of them."""
        s = self._settings
        if s.enable_homotopy_class_planning:
            passed = self._passed(task)
            initial = begun[0] if begun else first_band(task.plan, task.pose, s)
            usual = passed.class_of(initial)
            groups = _by_class(passed, kept, [*begun, *([] if begun else [initial])])
            self._explore(task, passed, groups)
        else:
            usual, groups = (), {(): [*kept[:1], *begun]}
        found = {}
        for key, bands in groups.items():
            cost = task.cost
            if key != usual and not s.viapoints_all_candidates:
                cost = replace(cost, vias=np.zeros((0, 2)))
            best = self._cheapest(bands, cost, task.feasible)
            if best is not None:
                found[key] = best, cost.for_selection(best)
        order = self._ordered(found, usual, next(iter(groups)) if stays else None)
        self._bands = [found[key][0] for key in order]
        return self._bands[0] if order else None

    def _passed(self, task: BandTask) -> PassedObstacles:
        x, y, _ = task.goal
        way = np.array([x - task.pose[0], y - task.pose[1]])
        across = np.array([-way[1], way[0]]) / max(float(np.hypot(*way)), 1e-9)
        return PassedObstacles.of(task.cost.obstacles, task.gap, task.cost.moving, across)

    def _explore(
        self, task: BandTask, passed: PassedObstacles, groups: dict[PathClass, list[Band]]
    ) -> None:
        """Add bands of classes that are not there yet."""
        s = self._settings
        if not len(passed.standing) and not passed.moving:
            return
        for path in paths_of_classes(
            task.pose, task.goal, passed, task.cost.obstacles, s, self._rng
        ):
            if len(groups) >= s.max_number_classes:
                return
            band = first_band(path, task.pose, s)
            groups.setdefault(passed.class_of(band), [band])

    def _cheapest(
        self, bands: list[Band], cost: BandCost, feasible: Callable[[Band], bool]
    ) -> Band | None:
        activate = self._settings.optimization_activate
        improved = [optimised(band, cost) if activate else band for band in bands]
        return min(filter(feasible, improved), key=cost.of, default=None)

    def _ordered(
        self,
        found: dict[PathClass, tuple[Band, float]],
        usual: PathClass,
        last: PathClass | None,
    ) -> list[PathClass]:
        """Return the classes, the chosen one first; detours are dropped."""
        s = self._settings
        costs = {key: cost for key, (_, cost) in found.items()}
        for key, factor in (
            (last, s.selection_cost_hysteresis),
            (usual, s.selection_prefer_initial_plan),
        ):
            if key in costs:
                costs[key] *= factor
        order = sorted(costs, key=lambda key: costs[key])
        if last in costs and order[0] != last:
            if self._since_switch <= s.switching_blocking_period:
                order.remove(last)
                order.insert(0, last)
            else:
                self._since_switch = 0.0
        longest = math.inf
        if order:
            longest = s.max_ratio_detours_duration_best_duration * found[order[0]][0].duration
        return [key for key in order if found[key][0].duration <= longest]


def _by_class(
    passed: PassedObstacles, kept: Iterable[Band], begun: Iterable[Band]
) -> dict[PathClass, list[Band]]:
    """Return bands by class: one that is kept, or all that are begun."""
    groups: dict[PathClass, list[Band]] = {}
    for band in kept:
        groups.setdefault(passed.class_of(band), [band])
    old = set(groups)
    for band in begun:
        key = passed.class_of(band)
        if key not in old:
            groups.setdefault(key, []).append(band)
    return groups
