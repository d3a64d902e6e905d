"""Timed elastic bands: a first one along a plan, resizing, and optimisation.

Optimisation is Levenberg's and Marquardt's. As residuals depend on three poses in a row at most, all
derivatives by x, y, heading and time come from twelve evaluations, each with every third pose moved.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from gazelle.array_types import Floats, Indices
from gazelle.navigation.angles import wrapped, wrapped_all
from gazelle.navigation.following import Pose2
from gazelle.navigation.planners.planar import composed
from gazelle.navigation.planners.teb_cost import Band, BandCost
from gazelle.navigation.planners.teb_equations import STRIDE, BandEquations
from gazelle.navigation.planners.teb_settings import TebSettings

_STEP: Final = 1e-6
_SHORTEST_S: Final = 0.01
_ENOUGH: Final = 1e-3
"""Share of the cost that an iteration has to save, for another one."""


def first_band(plan: Floats, start: Pose2, settings: TebSettings) -> Band:
    """Return a band along a plan, at the greatest speed.

    Args:
        plan: Poses to the goal, shape (n, 3).
        start: Pose of the robot.
        settings: Of the planner.
    """
    s = settings
    points = np.vstack((np.array(start[:2]), plan[:, :2]))
    apart = np.hypot(*np.diff(points, axis=0).T)
    along = np.concatenate(([0.0], np.cumsum(apart)))
    count = max(s.min_samples - 1, math.ceil(along[-1] / (s.max_vel_x * s.dt_ref)))
    places = np.linspace(0.0, along[-1], min(count, s.max_samples - 1) + 1)
    poses = np.zeros((len(places), 3))
    keep = np.concatenate(([True], apart > 1e-9))
    for axis in range(2):
        poses[:, axis] = np.interp(places, along[keep], points[keep, axis])
    ahead = np.arctan2(*np.gradient(poses[:, :2], axis=0).T[::-1])
    if not s.global_plan_overwrite_orientation:
        nearest = np.abs(along[1:] - places[:, None]).argmin(axis=1)
        ahead = plan[nearest, 2]
    away = plan[-1, :2] - points[0]
    if s.allow_init_with_backwards_motion and (
        away @ np.array([math.cos(start[2]), math.sin(start[2])]) < 0.0
    ):
        ahead = ahead + math.pi
    poses[:, 2] = ahead
    poses[0], poses[-1] = start, plan[-1]
    times = np.maximum(np.diff(places) / s.max_vel_x, _SHORTEST_S)
    turns = np.abs(wrapped_all(np.diff(poses[:, 2])))
    return Band(poses, np.maximum(times, turns / s.max_vel_theta))


def maneuvers(start: Pose2, goal: Pose2, settings: TebSettings) -> Iterator[Band]:
    """Yield bands of a car that first drives straight on or back, or ends so."""
    reach = 2.0 * settings.min_turning_radius
    for way in (reach, -reach):
        yield _through((start, composed(start, (way, 0.0, 0.0)), goal), settings)
        yield _through((start, composed(goal, (way, 0.0, 0.0)), goal), settings)


def _through(corners: Sequence[Pose2], settings: TebSettings) -> Band:
    """Return a band of straight legs; each is driven forwards or backwards, with less of a turn."""
    poses = [np.array(corners[0])]
    for first, last in itertools.pairwise(corners):
        dx, dy = last[0] - first[0], last[1] - first[1]
        count = max(2, math.ceil(math.hypot(dx, dy) / (settings.max_vel_x * settings.dt_ref)))
        ahead = math.atan2(dy, dx)
        if math.cos(ahead - first[2]) + math.cos(ahead - last[2]) < 0.0:
            ahead += math.pi
        poses += [
            np.array((first[0] + share * dx, first[1] + share * dy, ahead))
            for share in np.linspace(0.0, 1.0, count + 1)[1:]
        ]
    poses[-1] = np.array(corners[-1])
    return Band(np.array(poses), np.full(len(poses) - 1, settings.dt_ref))


def moved_on(band: Band, start: Pose2, goal: Pose2) -> Band:
    """Return the rest of a band from where the robot is now, to a new goal.

    Poses before the nearest one of the next few are passed.
    """
    near = band.poses[: min(10, len(band.poses) - 2), :2]
    first = int(np.hypot(*(near - np.array(start[:2])).T).argmin()) if len(near) else 0
    poses, times = band.poses[first:].copy(), band.times[first:].copy()
    poses[0], poses[-1] = start, goal
    return Band(poses, times)


def resized(band: Band, settings: TebSettings) -> Band:
    """Return a band whose times are near ``dt_ref``: long ones are split, short ones joined."""
    s = settings
    poses, times = list(band.poses), list(band.times)
    for _ in range(100):
        index = next(
            (
                i
                for i, time in enumerate(times)
                if (time > s.dt_ref + s.dt_hysteresis and len(poses) < s.max_samples)
                or (time < s.dt_ref - s.dt_hysteresis and len(poses) > s.min_samples)
            ),
            None,
        )
        if index is None:
            break
        if times[index] > s.dt_ref:
            turn = wrapped(float(poses[index + 1][2] - poses[index][2]))
            between = 0.5 * (poses[index] + poses[index + 1])
            between[2] = poses[index][2] + 0.5 * turn
            poses.insert(index + 1, between)
            times[index : index + 1] = [0.5 * times[index]] * 2
        else:
            first = min(index, len(times) - 2)
            times[first : first + 2] = [times[first] + times[first + 1]]
            poses.pop(first + 1)
    return Band(np.array(poses), np.array(times))


def optimised(band: Band, cost: BandCost) -> Band:
    """Return the band after the iterations that the settings name, resized before each outer one."""
    s = cost.settings
    for _ in range(s.no_outer_iterations):
        if s.teb_autosize:
            band = resized(band, s)
        cost = replace(cost, arrivals=band.arrivals() if cost.moving else None)
        band = _improved(band, cost, s.no_inner_iterations)
        cost = replace(cost, obstacle_weight=cost.obstacle_weight * s.weight_adapt_factor)
    return band


def _improved(band: Band, cost: BandCost, iterations: int) -> Band:
    damping = 1e-3
    residuals = cost.residuals(band)
    for _ in range(iterations):
        before = float(residuals @ residuals)
        first = cost.first_poses(len(band.times))
        derivatives = _derivatives(band, cost, residuals, first)
        equations = BandEquations(derivatives, first, residuals, len(band.poses))
        for _ in range(4):
            tried = _stepped(band, equations.step(damping))
            found = cost.residuals(tried)
            if found @ found < before:
                band, residuals, damping = tried, found, max(0.2 * damping, 1e-6)
                break
            damping *= 10.0
        else:
            break
        if before - float(residuals @ residuals) < _ENOUGH * before:
            break
    return band


def _stepped(band: Band, step: Floats) -> Band:
    """Return a band after a step of all inner poses and all times."""
    poses = band.poses.copy()
    poses[1:-1] += step[1:-1, :3]
    return Band(poses, np.maximum(band.times + step[:-1, 3], _SHORTEST_S))


def _derivatives(band: Band, cost: BandCost, residuals: Floats, first: Indices) -> Floats:
    """Return derivatives by x, y, heading and time of the three poses of each residual."""
    count = len(band.times)
    rows = np.arange(len(residuals))
    found = np.zeros((len(residuals), STRIDE, 4))
    for color in range(STRIDE):
        # The one pose of this color that a residual may depend on.
        place = (color - first) % STRIDE
        pose = first + place
        for variable in range(4):
            poses, times = band.poses.copy(), band.times.copy()
            if variable < 3:
                poses[color::STRIDE, variable] += _STEP
                free = (pose > 0) & (pose < count)
            else:
                times[color::STRIDE] += _STEP
                free = pose < count
            change = (cost.residuals(Band(poses, times)) - residuals) / _STEP
            found[rows, place, variable] = np.where(free, change, 0.0)
    return found
