"""Residuals of a timed elastic band: what a trajectory of poses and times costs.

Method: C. Roesmann et al., "Trajectory modification considering dynamic constraints of autonomous
robots", ROBOTIK 2012, and "Kinodynamic trajectory optimization and control for car-like robots",
IROS 2017. Each residual depends on at most three poses in a row and the times after the first two.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats, Indices
from gazelle.navigation.angles import wrapped_all
from gazelle.navigation.planners.teb_obstacles import (
    NOWHERE,
    BandObstacle,
    ObstacleDistances,
    nearest,
)
from gazelle.navigation.planners.teb_settings import TebFootprint, TebSettings


@dataclass(frozen=True, slots=True)
class Band:
    """A trajectory: poses, and the times between them.

    Attributes:
        poses: x, y [m] and heading [rad], shape (n + 1, 3); headings may exceed pi.
        times: [s], shape (n,).
    """

    poses: Floats
    times: Floats

    def velocities(self) -> tuple[Floats, Floats, Floats]:
        """Return velocities ahead, to the left [m/s] and turning [rad/s] in all intervals."""
        ahead, aside, turn = self.steps()
        return ahead / self.times, aside / self.times, turn / self.times

    @property
    def duration(self) -> float:
        """Time from the first pose to the last one [s]."""
        return float(self.times.sum())

    def arrivals(self) -> Floats:
        """Return the times from now to all poses, shape (n + 1,) [s]."""
        return np.concatenate(([0.0], np.cumsum(self.times)))

    def steps(self) -> tuple[Floats, Floats, Floats]:
        """Return steps ahead, to the left [m] and turns [rad], each in the middle of its turn."""
        step = np.diff(self.poses, axis=0)
        turn = wrapped_all(step[:, 2])
        middle = self.poses[:-1, 2] + 0.5 * turn
        cos, sin = np.cos(middle), np.sin(middle)
        ahead = step[:, 0] * cos + step[:, 1] * sin
        return ahead, step[:, 1] * cos - step[:, 0] * sin, turn


@dataclass(frozen=True, slots=True)
class BandCost:
    """Residuals of a band.

    Attributes:
        settings: Limits and weights.
        footprint: Of the robot.
        obstacles: Distances to those that stand.
        velocity: Of the robot now: ahead, to the left [m/s], turning [rad/s].
        stops: Whether the band ends at rest.
        vias: Points that the band should pass, shape (n, 2).
        obstacle_weight: Present weight of obstacles.
        moving: Obstacles with a velocity.
        arrivals: Assumed times to all poses [s], as where an obstacle is then must not depend on
            all times before; None takes the band's own.
    """

    settings: TebSettings
    footprint: TebFootprint
    obstacles: ObstacleDistances
    velocity: tuple[float, float, float]
    stops: bool
    vias: Floats
    obstacle_weight: float
    moving: Sequence[BandObstacle] = ()
    arrivals: Floats | None = None

    def of(self, band: Band) -> float:
        """Return the cost of a band."""
        residuals = self.residuals(band)
        return float(residuals @ residuals)

    def for_selection(self, band: Band) -> float:
        """Return the cost that bands of different classes are compared by."""
        s = self.settings
        found = self._of_motion(band)
        if s.selection_alternative_time_cost:
            found[0] = np.sqrt(band.times)
        return (
            _squared(found)
            + s.selection_obst_cost_scale * _squared(self._of_obstacles(band))
            + s.selection_viapoint_cost_scale * _squared([self._of_vias(band)])
        )

    def _clearances(self, band: Band) -> tuple[Floats, Floats]:
        """Return the robot's distances to standing and to moving obstacles at inner poses [m]."""
        poses = band.poses[1:-1]
        cos, sin = np.cos(poses[:, 2])[:, None], np.sin(poses[:, 2])[:, None]
        x, y = self.footprint.centers.T
        points = np.stack(
            (poses[:, :1] + cos * x - sin * y, poses[:, 1:2] + sin * x + cos * y), axis=-1
        )
        radii = self.footprint.radii
        standing: Floats = (self.obstacles.at(points) - radii).min(axis=1)
        if not self.moving:
            return standing, np.full(len(poses), NOWHERE)
        times = (band.arrivals() if self.arrivals is None else self.arrivals)[1:-1]
        return standing, (nearest(self.moving, points, times) - radii).min(axis=1)

    def first_poses(self, count: int) -> Indices:
        """Return the first pose that each residual depends on, for a number of intervals."""
        every = np.arange(count)
        pairs = np.concatenate(([0], every[:-1], [count - 1]))
        return np.concatenate((*[every] * 8, *[pairs] * 3, *[every[1:]] * 5))

    def residuals(self, band: Band) -> Floats:
        """Return all residuals, in the order of ``first_poses``; the cost is the sum of squares."""
        parts = [*self._of_motion(band), *self._of_obstacles(band), self._of_vias(band)]
        return np.concatenate(parts)

    def _of_motion(self, band: Band) -> list[Floats]:
        s, times = self.settings, band.times
        ahead, aside, turn = band.steps()
        v, u, w = ahead / times, aside / times, turn / times
        strafes = s.max_vel_y > 0.0
        # Either velocity of a robot that strafes may be about 0, where there is no margin.
        epsilon = 0.0 if strafes else s.penalty_epsilon
        margin = min(epsilon, 0.5 * s.max_vel_x)
        back = min(epsilon, 0.5 * s.max_vel_x_backwards)
        about = min(s.penalty_epsilon, 0.5 * s.max_vel_theta)
        along = _rest(s.fastest, u) if strafes else s.max_vel_x
        car = s.min_turning_radius > 0.0
        tight = np.maximum(s.min_turning_radius * np.abs(turn) - np.abs(ahead), 0.0)
        parts = [
            math.sqrt(s.weight_optimaltime) * times,
            math.sqrt(s.weight_shortest_path) * np.hypot(ahead, aside),
            math.sqrt(s.weight_max_vel_x)
            * (
                np.maximum(v - np.minimum(s.max_vel_x, along) + margin, 0.0)
                + np.maximum(back - np.minimum(s.max_vel_x_backwards, along) - v, 0.0)
            ),
            (math.sqrt(s.weight_max_vel_y) if strafes else 0.0)
            * np.maximum(np.abs(u) - np.minimum(s.max_vel_y, _rest(s.fastest, v)), 0.0),
            math.sqrt(s.weight_max_vel_theta) * _over(w, s.max_vel_theta - about),
            math.sqrt(s.weight_kinematics_nh) * 2.0 * aside,
            # Of lengths, not of radii, which are infinite straight on.
            math.sqrt(_TIGHT * s.weight_kinematics_turning_radius) * tight,
            (0.0 if car else math.sqrt(s.weight_kinematics_forward_drive))
            * np.maximum(-ahead, 0.0),
        ]
        limits = (
            (v, s.acc_lim_x, s.weight_acc_lim_x),
            (u, s.acc_lim_y, s.weight_acc_lim_y if strafes else 0.0),
            (w, s.acc_lim_theta, s.weight_acc_lim_theta),
        )
        spans = np.concatenate((times[:1], 0.5 * (times[1:] + times[:-1]), times[-1:]))
        for now, (speed, limit, weight) in zip(self.velocity, limits, strict=True):
            change = np.diff(speed, prepend=now, append=0.0)
            if not self.stops:
                change[-1] = 0.0
            parts.append(math.sqrt(weight) * _over(change / spans, limit))
        return parts

    def _of_obstacles(self, band: Band) -> list[Floats]:
        s = self.settings
        clear, ahead = self._clearances(band)
        required = s.min_obstacle_dist + s.penalty_epsilon
        lacking = np.maximum(required - clear, 0.0)
        if s.obstacle_cost_exponent != 1.0 and s.min_obstacle_dist > 0.0:
            share = lacking / s.min_obstacle_dist
            lacking = s.min_obstacle_dist * share**s.obstacle_cost_exponent
        far = s.dynamic_obstacle_inflation_dist
        return [
            math.sqrt(self.obstacle_weight) * lacking,
            math.sqrt(s.weight_inflation) * np.maximum(s.inflation_dist - clear, 0.0),
            math.sqrt(s.weight_dynamic_obstacle) * np.maximum(required - ahead, 0.0),
            math.sqrt(s.weight_dynamic_obstacle_inflation) * np.maximum(far - ahead, 0.0),
        ]

    def _of_vias(self, band: Band) -> Floats:
        """Return how far each pose is from the point that it should pass; 0 where it need not."""
        inner = band.poses[1:-1]
        off = np.zeros(len(inner))
        if len(self.vias) and len(inner):
            away = np.hypot(*(inner[:, None, :2] - self.vias).transpose(2, 0, 1))
            nearest_poses = away.argmin(axis=0)
            np.maximum.at(off, nearest_poses, away[nearest_poses, np.arange(len(self.vias))])
        return math.sqrt(self.settings.weight_viapoint) * off


_TIGHT = 1e4  # Weight of a turn that is too tight, for that of the original


def _over(values: Floats, limit: float) -> Floats:
    """Return by how much values exceed a limit, to either side."""
    return np.maximum(np.abs(values) - limit, 0.0)


def _rest(most: float, used: Floats) -> Floats:
    """Return the speed that is left in one direction, of a speed in any direction."""
    found: Floats = np.sqrt(np.maximum(most * most - used * used, 0.0))
    return found


def _squared(parts: Sequence[Floats]) -> float:
    return float(sum(part @ part for part in parts))
