"""Drive to a goal over unknown ground: map, plan, follow, avoid."""

from __future__ import annotations

import math
import warnings
from collections import deque
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.errors import SimulationError
from gazelle.navigation.angles import wrapped
from gazelle.navigation.avoidance import safe_velocity
from gazelle.navigation.following import Pose2, following_velocity, turn_to
from gazelle.navigation.grid import OccupancyGrid
from gazelle.navigation.limits import BaseLimits
from gazelle.navigation.planning import is_blocked, plan
from gazelle.sensors import LaserScan

_HORIZON = 6.0  # what is farther away is not put on the map [m]
_PLAN_EVERY = 0.5  # least time between two plans [s]
_WAIT = 2.0  # the same if there was no path [s]
_STRAY = 0.35  # a base farther off its path gets a new one [m]
_STUCK_AFTER = 4.0  # without getting anywhere, it looks around [s]
_LOOK_AROUND = 2.0  # [s]
_HISTORY = 64  # poses that are kept to place scans on


@checked(SimulationError)
class GoalSeeker:
    """Drives one base from goal to goal, in the frame of its odometry.

    Plain numbers in, plain numbers out; it knows no simulation. Nothing is known about the
    ground at first: what the laser sees is put on a map, unknown ground counts as free, and
    the path is planned again when something turns up on it. Of a goal too near to an obstacle
    the nearest free place is taken; without a path, it waits for one.

    Args:
        limits: Of the base.
        laser: Pose of the laser in the base (x, y, yaw) [m, rad].
        resolution: Of the map [m].
        tolerance: A goal is reached within this distance [m].
        yaw_tolerance: And this error of heading, if the goal has one [rad].

    Attributes:
        grid: The map.
        path: Points (x, y) to the goal [m], shape (n, 2); empty without one.
        arrived: Whether the last goal is reached.
        plans: Counts plans.
    """

    def __init__(
        self,
        limits: BaseLimits | None = None,
        *,
        laser: Sequence[float] = (0.0, 0.0, 0.0),
        resolution: float = 0.05,
        tolerance: float = 0.1,
        yaw_tolerance: float = 0.1,
    ) -> None:
        self.limits = limits or BaseLimits()
        self.grid = OccupancyGrid(resolution)
        self.path: Floats = np.zeros((0, 2))
        self.arrived = False
        self._turning = False
        self.plans = 0
        self._laser = tuple(laser)
        self._tolerance, self._yaw_tolerance = tolerance, yaw_tolerance
        self._goal: Floats | None = None
        self._poses: deque[tuple[float, Pose2]] = deque(maxlen=_HISTORY)
        self._seen: Floats = np.zeros((0, 2))
        self._velocity = (0.0, 0.0)
        self._scanned_at = -math.inf
        self._planned_at = -math.inf
        self._best, self._best_at = math.inf, 0.0

    @property
    def goal(self) -> tuple[float, ...] | None:
        """Goal (x, y) or (x, y, yaw); None without one."""
        return None if self._goal is None else tuple(self._goal[~np.isnan(self._goal)].tolist())

    def set_goal(self, goal: Sequence[float]) -> None:
        """Set another goal.

        Args:
            goal: (x, y) or (x, y, yaw) [m, rad].
        """
        self._goal = np.array([*goal, math.nan][:3], np.float64)
        self.arrived = self._turning = False
        self.path = np.zeros((0, 2))
        self._planned_at, self._best = -math.inf, math.inf

    def seek(self, goal: Sequence[float]) -> None:
        """Set another goal; deprecated, use `set_goal`."""
        warnings.warn(DeprecationWarning("GoalSeeker.seek is called set_goal now"), stacklevel=2)
        self.set_goal(goal)

    def stop(self) -> None:
        """Clear the goal; the map stays."""
        self._goal = None
        self.path = np.zeros((0, 2))
        self._turning = False

    def update(self, pose: Pose2, scan: LaserScan | None, time: float) -> tuple[float, float]:
        """Return the velocity command for now.

        Args:
            pose: x, y [m] and heading [rad] in the frame of the goal.
            scan: The last scan of one row, ranges of shape (n,); None if there is none yet.
            time: Now [s]; it never goes back.

        Returns:
            Forward [m/s] and turning [rad/s] velocity to command.
        """
        interval = time - self._poses[-1][0] if self._poses else 0.0
        interval = min(max(interval, 0.01), 0.5)
        self._poses.append((time, pose))
        if scan is not None and scan.stamp / 1e9 != self._scanned_at:
            self._insert_scan(scan)
        if self._goal is None or scan is None:
            self._velocity = (0.0, 0.0)
            return self._velocity
        desired = self._desired_velocity(pose, time)
        points = _in_frame(self._seen, pose)
        self._velocity = safe_velocity(desired, self._velocity, points, interval, self.limits)
        return self._velocity

    def _desired_velocity(self, pose: Pose2, time: float) -> tuple[float, float]:
        """Return the velocity that would be right without obstacles."""
        self._plan(pose, time)
        if not len(self.path):
            return 0.0, 0.0
        if self._is_there(pose):
            if not self._replaced(time):
                return self._finish(pose)
            self._plan(pose, time, force=True)
            if not len(self.path) or self._is_there(pose):
                return 0.0, 0.0
        self._turning = False
        if self._is_stuck(pose, time):
            return 0.0, 0.5 * self.limits.angular
        return following_velocity(self.path, pose, self.limits)

    def _is_there(self, pose: Pose2) -> bool:
        """Return whether the end of the path is reached; turning there may shift the base a little."""
        there = self._tolerance * (2.0 if self._turning else 1.0)
        return math.dist(self.path[-1], pose[:2]) <= there

    def _replaced(self, time: float) -> bool:
        """Return whether the path ends beside a goal that may be free by now: the map has grown."""
        if self._goal is None or self._turning or time - self._planned_at < _PLAN_EVERY:
            return False
        return math.dist(self.path[-1], self._goal[:2]) > 1e-6

    def _finish(self, pose: Pose2) -> tuple[float, float]:
        """Return the turn to the heading of the goal, if it has one, or rest."""
        yaw = math.nan if self._goal is None else float(self._goal[2])
        self._turning = True
        if not math.isnan(yaw) and abs(wrapped(yaw - pose[2])) > self._yaw_tolerance:
            return 0.0, turn_to(yaw, pose, self.limits)
        if any(self._velocity):
            return 0.0, 0.0
        self.stop()
        self.arrived = True
        return 0.0, 0.0

    def _plan(self, pose: Pose2, time: float, *, force: bool = False) -> None:
        """Plan if there is no path, or if it is no good any more, but not too often."""
        pause = _PLAN_EVERY if len(self.path) else _WAIT
        if self._goal is None or time - self._planned_at < pause:
            return
        here = np.array(pose[:2])
        if len(self.path) and not force:
            near = float(np.hypot(*(self.path - here).T).min())
            if near < _STRAY and not is_blocked(self.grid, self.path, here, self.limits):
                return
        self.path = plan(self.grid, here, self._goal[:2], self.limits)
        self.plans += 1
        self._planned_at = time
        self._best, self._best_at = math.inf, time

    def _is_stuck(self, pose: Pose2, time: float) -> bool:
        """Return whether it made no progress for a while, so that it should look around."""
        ahead = np.hypot(*(self.path - np.array(pose[:2])).T)
        left = len(self.path) - int(ahead.argmin()) + float(ahead.min())
        if left < self._best - 1.0:
            self._best, self._best_at = left, time
        waiting = time - self._best_at
        if waiting > _STUCK_AFTER + _LOOK_AROUND:
            self.path, self._planned_at = np.zeros((0, 2)), -math.inf
        return waiting > _STUCK_AFTER

    def _insert_scan(self, scan: LaserScan) -> None:
        """Insert a scan into the map, from the pose of the base at its time."""
        self._scanned_at = scan.stamp / 1e9
        x, y, yaw = self._pose_at(self._scanned_at)
        at_x, at_y, turned = self._laser
        cos, sin = math.cos(yaw), math.sin(yaw)
        place = np.array([x + cos * at_x - sin * at_y, y + sin * at_x + cos * at_y])
        ranges = np.asarray(scan.ranges, np.float64)
        angles = yaw + turned + scan.angle_min + scan.angle_increment * np.arange(len(ranges))
        useful = ~np.isnan(ranges) & (ranges > 0.0)
        ranges, angles = ranges[useful], angles[useful]
        most = min(scan.range_max, _HORIZON)
        lengths = np.minimum(ranges, most)
        ends = place + lengths[:, None] * np.stack((np.cos(angles), np.sin(angles)), axis=1)
        hits = ranges < most
        self._seen = ends[hits]
        self.grid.insert(place, ends, hits)

    def _pose_at(self, time: float) -> Pose2:
        """Return the base's pose at a time, interpolated between the poses it received."""
        times = [when for when, _ in self._poses]
        after = int(np.searchsorted(times, time))
        if after >= len(times):
            return self._poses[-1][1]
        if after == 0:
            return self._poses[0][1]
        (start, first), (end, second) = self._poses[after - 1], self._poses[after]
        share = (time - start) / (end - start)
        turned = wrapped(second[2] - first[2])
        return (
            first[0] + share * (second[0] - first[0]),
            first[1] + share * (second[1] - first[1]),
            first[2] + share * turned,
        )

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state, for a snapshot."""
        goal = np.full(3, math.inf) if self._goal is None else self._goal
        numbers = [*self._velocity, self._scanned_at, self._planned_at, self._best, self._best_at]
        return {
            "cells": self.grid.cells.copy(),
            "origin": self.grid.origin.copy(),
            "goal": goal.copy(),
            "path": self.path.copy(),
            "seen": self._seen.copy(),
            "poses": np.array([(time, *pose) for time, pose in self._poses]).reshape(-1, 4),
            "numbers": np.array([*numbers, self.arrived, self.plans, self._turning]),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        held = {name: np.array(values, np.float64) for name, values in state.items()}
        self.grid.cells, self.grid.origin = held["cells"], held["origin"]
        self._goal = None if np.isinf(held["goal"]).all() else held["goal"]
        self.path, self._seen = held["path"], held["seen"]
        self._poses.clear()
        self._poses.extend((t, (x, y, yaw)) for t, x, y, yaw in held["poses"].tolist())
        numbers = held["numbers"].tolist()
        self._velocity = (numbers[0], numbers[1])
        self._scanned_at, self._planned_at, self._best, self._best_at = numbers[2:6]
        self.arrived, self.plans, self._turning = bool(numbers[6]), int(numbers[7]), numbers[8] > 0


def _in_frame(points: Floats, pose: Pose2) -> Floats:
    """Return points of the ground in the frame of the base, shape (n, 2)."""
    x, y, yaw = pose
    cos, sin = math.cos(yaw), math.sin(yaw)
    turn = np.array([[cos, -sin], [sin, cos]])
    seen: Floats = (points - (x, y)) @ turn
    return seen
