"""Residuals of a timed elastic band: what a trajectory of poses and times costs.

Method: C. Roesmann et al., "Trajectory modification considering dynamic constraints of autonomous
robots", ROBOTIK 2012, and "Kinodynamic trajectory optimization and control for car-like robots",
IROS 2017. Each residual depends on at most three poses in a row and the times after the first two.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats, Indices
from gazelle.navigation.angles import wrapped_all
from gazelle.navigation.planners.teb_settings import TebFootprint, TebSettings

_NO_OBSTACLE = 1e3  # Distance where there is none [m]


@dataclass(frozen=True, slots=True)
class ObstacleDistances:
    """Distances to obstacles on a grid.

    Attributes:
        values: From the middles of cells [m], shape (rows, columns); None without any obstacle.
        origin: Corner of the grid [m].
        resolution: Side of a cell [m].
    """

    values: Floats | None
    origin: tuple[float, float]
    resolution: float

    def at(self, points: Floats) -> Floats:
        """Return the distances at points, shape (..., 2), between cells bilinearly."""
        if self.values is None:
            return np.full(points.shape[:-1], _NO_OBSTACLE)
        rows, columns = self.values.shape
        place = (points - np.array(self.origin)) / self.resolution - 0.5
        x = np.clip(place[..., 0], 0.0, columns - 1.001)
        y = np.clip(place[..., 1], 0.0, rows - 1.001)
        column, row = x.astype(np.intp), y.astype(np.intp)
        s, t = x - column, y - row
        v = self.values
        low = (1.0 - s) * v[row, column] + s * v[row, column + 1]
        high = (1.0 - s) * v[row + 1, column] + s * v[row + 1, column + 1]
        found: Floats = (1.0 - t) * low + t * high
        return found


@dataclass(frozen=True, slots=True)
class Band:
    """A trajectory: poses, and the times between them.

    Attributes:
        poses: x, y [m] and heading [rad], shape (n + 1, 3); headings may exceed pi.
        times: [s], shape (n,).
    """

    poses: Floats
    times: Floats

    def velocities(self) -> tuple[Floats, Floats]:
        """Return forward [m/s] and turning [rad/s] velocities of all intervals."""
        step = np.diff(self.poses, axis=0)
        turn = wrapped_all(step[:, 2])
        middle = self.poses[:-1, 2] + 0.5 * turn
        ahead = step[:, 0] * np.cos(middle) + step[:, 1] * np.sin(middle)
        return ahead / self.times, turn / self.times


@dataclass(frozen=True, slots=True)
class BandCost:
    """Residuals of a band.

    Attributes:
        settings: Limits and weights.
        footprint: Of the robot.
        obstacles: Distances to them.
        velocity: Of the robot now: forward [m/s], turning [rad/s].
        stops: Whether the band ends at rest.
        vias: Points that the band should pass, shape (n, 2).
        obstacle_weight: Present weight of obstacles.
    """

    settings: TebSettings
    footprint: TebFootprint
    obstacles: ObstacleDistances
    velocity: tuple[float, float]
    stops: bool
    vias: Floats
    obstacle_weight: float

    def of(self, band: Band) -> float:
        """Return the cost of a band."""
        residuals = self.residuals(band)
        return float(residuals @ residuals)

    def clearances(self, poses: Floats) -> Floats:
        """Return the robot's distance to obstacles at poses [m]."""
        cos, sin = np.cos(poses[:, 2])[:, None], np.sin(poses[:, 2])[:, None]
        x, y = self.footprint.centers.T
        points = np.stack(
            (poses[:, :1] + cos * x - sin * y, poses[:, 1:2] + sin * x + cos * y), axis=-1
        )
        found: Floats = (self.obstacles.at(points) - self.footprint.radii).min(axis=1)
        return found

    def first_poses(self, count: int) -> Indices:
        """Return the first pose that each residual depends on, for a number of intervals."""
        every = np.arange(count)
        pairs = np.concatenate(([0], every[:-1], [count - 1]))
        return np.concatenate((*[every] * 7, pairs, pairs, every[1:], every[1:], every[1:]))

    def residuals(self, band: Band) -> Floats:
        """Return all residuals, in the order of ``first_poses``; the cost is the sum of squares."""
        s, times = self.settings, band.times
        step = np.diff(band.poses, axis=0)
        turn = wrapped_all(step[:, 2])
        middle = band.poses[:-1, 2] + 0.5 * turn
        cos, sin = np.cos(middle), np.sin(middle)
        ahead, aside = step[:, 0] * cos + step[:, 1] * sin, step[:, 1] * cos - step[:, 0] * sin
        v, w = ahead / times, turn / times
        margin = min(s.penalty_epsilon, 0.5 * s.max_vel_x)
        back = min(s.penalty_epsilon, 0.5 * s.max_vel_x_backwards)
        about = min(s.penalty_epsilon, 0.5 * s.max_vel_theta)
        car = s.min_turning_radius > 0.0
        tight = np.maximum(s.min_turning_radius * np.abs(turn) - np.abs(ahead), 0.0)
        parts = [
            math.sqrt(s.weight_optimaltime) * times,
            math.sqrt(s.weight_shortest_path) * np.hypot(ahead, aside),
            math.sqrt(s.weight_max_vel_x)
            * (
                np.maximum(v - s.max_vel_x + margin, 0.0)
                + np.maximum(back - s.max_vel_x_backwards - v, 0.0)
            ),
            math.sqrt(s.weight_max_vel_theta) * _over(w, s.max_vel_theta - about),
            math.sqrt(s.weight_kinematics_nh) * 2.0 * aside,
            # Of lengths, not of radii, which are infinite straight on.
            math.sqrt(_TIGHT * s.weight_kinematics_turning_radius) * tight,
            (0.0 if car else math.sqrt(s.weight_kinematics_forward_drive))
            * np.maximum(-ahead, 0.0),
        ]
        for speed, now, limit, weight in (
            (v, self.velocity[0], s.acc_lim_x, s.weight_acc_lim_x),
            (w, self.velocity[1], s.acc_lim_theta, s.weight_acc_lim_theta),
        ):
            change = np.diff(speed, prepend=now, append=0.0)
            spans = np.concatenate((times[:1], 0.5 * (times[1:] + times[:-1]), times[-1:]))
            if not self.stops:
                change[-1] = 0.0
            parts.append(math.sqrt(weight) * _over(change / spans, limit))
        inner = band.poses[1:-1]
        clear = self.clearances(inner)
        lacking = np.maximum(s.min_obstacle_dist + s.penalty_epsilon - clear, 0.0)
        if s.obstacle_cost_exponent != 1.0 and s.min_obstacle_dist > 0.0:
            share = lacking / s.min_obstacle_dist
            lacking = s.min_obstacle_dist * share**s.obstacle_cost_exponent
        parts.append(math.sqrt(self.obstacle_weight) * lacking)
        parts.append(math.sqrt(s.weight_inflation) * np.maximum(s.inflation_dist - clear, 0.0))
        parts.append(math.sqrt(s.weight_viapoint) * self._off_vias(inner))
        return np.concatenate(parts)

    def _off_vias(self, inner: Floats) -> Floats:
        """Return how far each pose is from the point that it should pass; 0 where it need not."""
        off = np.zeros(len(inner))
        if len(self.vias) and len(inner):
            away = np.hypot(*(inner[:, None, :2] - self.vias).transpose(2, 0, 1))
            nearest = away.argmin(axis=0)
            np.maximum.at(off, nearest, away[nearest, np.arange(len(self.vias))])
        return off


_TIGHT = 1e4  # Weight of a turn that is too tight, for that of the original


def _over(values: Floats, limit: float) -> Floats:
    """Return by how much values exceed a limit, to either side."""
    return np.maximum(np.abs(values) - limit, 0.0)
