"""Particle filter of a robot's pose: weighting, resampling and the estimate.

Method: adaptive particle numbers by the Kullback-Leibler distance (D. Fox, "Adapting the sample size
in particle filters through KLD-sampling", 2003), and random particles when scans fit worse than
they did (Gutmann and Fox, 2002), with the bins and rules of ``amcl``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Indices
from gazelle.errors import Error
from gazelle.navigation.limits import MAX_PARTICLES
from gazelle.navigation.localization.pose_bins import PoseBins

_SIDE = 0.5
_TURN = math.radians(10.0)
"""Sides of the bins that are counted [m, rad]."""


@dataclass(frozen=True, slots=True)
class PoseEstimate:
    """Pose estimate of a particle filter.

    Attributes:
        pose: Mean of the heaviest cluster: x, y [m] and heading [rad], shape (3,).
        covariance: Of all particles, shape (3, 3).
        weight: Of that cluster.
    """

    pose: Floats
    covariance: Floats
    weight: float


_CONVERGED = 0.5
"""As in the original [m]."""


@checked(Error, after=True)
class ParticleFilter:
    """Particles in the plane.

    Args:
        least: Number of particles at least.
        most: Number at most.
        error: Greatest error of their distribution (``kld_err``).
        quantile: Of the standard normal distribution (``kld_z``).
        slow: Decay of the slow average of weights; 0 for no random particles.
        fast: Decay of the fast average.
        random: Draws.

    Attributes:
        poses: x, y [m] and heading [rad], shape (n, 3).
        weights: Weights, with a sum of 1, shape (n,).
        converged: Whether all were within half a metre of their mean after the last resampling.

    Raises:
        Error: There are no particles, or too many.
    """

    def __init__(
        self,
        least: int,
        most: int,
        error: float,
        quantile: float,
        slow: float,
        fast: float,
        random: np.random.Generator,
    ) -> None:
        if not 0 < max(most, least) <= MAX_PARTICLES:
            raise Error(f"a filter has 1 to {MAX_PARTICLES:,} particles, not {least} to {most}")
        self.least, self.most = least, max(most, least)
        self.error, self.quantile = error, quantile
        self.slow, self.fast = slow, fast
        self._random = random
        self.poses: Floats = np.zeros((self.most, 3))
        self.weights: Floats = np.full(self.most, 1.0 / self.most)
        self._long = self._short = 0.0
        self.converged = False

    def spread(self, mean: Floats, covariance: Floats) -> None:
        """Initialise with a normal distribution: mean shape (3,), covariance (3, 3)."""
        values, axes = np.linalg.eigh(covariance)
        noise = self._random.standard_normal((self.most, 3)) * np.sqrt(np.maximum(values, 0.0))
        self.begin(np.asarray(mean) + noise @ axes.T)

    def begin(self, poses: Floats) -> None:
        """Initialise with these particles, shape (n, 3).

        Raises:
            Error: They are of another shape, or too many.
        """
        rows = np.ascontiguousarray(poses, np.float64)
        if rows.ndim != 2 or rows.shape[1] != 3 or not 0 < len(rows) <= MAX_PARTICLES:
            raise Error(f"poses of particles have the shape (n, 3), not {rows.shape}")
        self.poses = rows
        self.weights = np.full(len(rows), 1.0 / len(rows))
        self._long = self._short = 0.0
        self.converged = False

    def weigh(self, scores: Floats) -> None:
        """Multiply weights, shape (n,), and learn how well scans fit on average."""
        self.weights = self.weights * scores
        total = float(self.weights.sum())
        if not total > 0.0:
            self.weights = np.full(len(self.poses), 1.0 / len(self.poses))
            return
        # Weights summed up to 1, so this is how well the scan fits on average. (amcl divides by the number of
        # particles once more, and so takes fewer of them for a better fit.)
        average = total
        self._long = average if not self._long else self._long + self.slow * (average - self._long)
        self._short = (
            average if not self._short else self._short + self.fast * (average - self._short)
        )
        self.weights = self.weights / total

    def effective(self) -> float:
        """Return the effective number of particles."""
        return float(1.0 / (self.weights**2).sum())

    def resample(self, anywhere: Callable[[int], Floats]) -> None:
        """Resample particles by their weights, as many as their spread needs.

        Args:
            anywhere: Draws a given number of poses from all over the map, shape (n, 3).
        """
        lost = max(0.0, 1.0 - self._short / self._long) if self._long > 0.0 else 0.0
        sums = np.cumsum(self.weights)
        # Evenly spaced draws vary less than independent ones; shuffled, any number of the first ones
        # is a fair sample.
        even = (np.arange(self.most) + self._random.random()) * (sums[-1] / self.most)
        drawn = np.searchsorted(sums, even, side="right")
        self._random.shuffle(drawn)
        poses = self.poses.take(np.minimum(drawn, len(self.poses) - 1), axis=0)
        if lost > 0.0:
            elsewhere = self._random.random(self.most) < lost
            poses[elsewhere] = anywhere(int(elsewhere.sum()))
            self._long = self._short = 0.0
        bins = PoseBins(poses, _SIDE, _TURN)
        needed = self.needed(np.arange(bins.count + 1))[bins.counts()]
        enough = np.flatnonzero(np.arange(1, self.most + 1) > needed)
        count = int(enough[0]) + 1 if len(enough) else self.most
        self.poses = np.ascontiguousarray(poses[:count])
        self.weights = np.full(count, 1.0 / count)
        places = np.ascontiguousarray(self.poses[:, :2].T)
        off = np.abs(places - places.mean(axis=1, keepdims=True))
        self.converged = bool(off.max() <= _CONVERGED)

    def needed(self, bins: Indices) -> Floats:
        """Return the number of particles that this many occupied bins need, between least and most."""
        k = np.maximum(np.asarray(bins, np.float64) - 1.0, 1e-9)
        share = 2.0 / (9.0 * k)
        x = 1.0 - share + np.sqrt(share) * self.quantile
        count = np.ceil(k / (2.0 * self.error) * x**3)
        bounded: Floats = np.clip(count, self.least, self.most)
        return np.where(np.asarray(bins) <= 1, float(self.most), bounded)

    def estimate(self) -> PoseEstimate:
        """Return the estimate: the mean of the heaviest cluster."""
        labels = PoseBins(self.poses, _SIDE, _TURN).clusters()
        heaviest = int(np.bincount(labels, self.weights).argmax())
        own = np.where(labels == heaviest, self.weights, 0.0)
        x, y, heading = np.ascontiguousarray(self.poses.T)
        # What is averaged: place and direction. Sums, as products of matrices are left to several threads,
        # with a number that would show in the last bits.
        values = np.stack((x, y, np.cos(heading), np.sin(heading)))
        weight = float(own.sum())
        at_x, at_y, cos, sin = ((values * own).sum(axis=1) / weight).tolist()
        return PoseEstimate(
            np.array([at_x, at_y, math.atan2(sin, cos)]), _covariance(values, self.weights), weight
        )


def _covariance(values: Floats, weights: Floats) -> Floats:
    """Return the covariance of place and the circular variance of headings, shape (3, 3).

    Args:
        values: x, y [m], cosine and sine of the heading, shape (4, n).
        weights: Shape (n,).
    """
    share = weights / weights.sum()
    means = (values * share).sum(axis=1)
    x, y = values[:2] - means[:2, None]
    found = np.zeros((3, 3))
    found[0, 0], found[1, 1] = (share * x * x).sum(), (share * y * y).sum()
    found[0, 1] = found[1, 0] = (share * x * y).sum()
    length = math.hypot(means[2], means[3])
    found[2, 2] = -2.0 * math.log(max(min(length, 1.0), 1e-12))
    return found
