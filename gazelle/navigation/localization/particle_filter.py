"""Where a robot may be, as particles: weighing, resampling and what they agree on.

Method: adaptive particle numbers by the Kullback-Leibler distance (D. Fox, "Adapting the sample size
in particle filters through KLD-sampling", 2003), and random particles when scans fit worse than
they did (Gutmann and Fox, 2002), with the bins and rules of ``amcl``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Bools, Floats, Indices

_BIN = np.array([0.5, 0.5, math.radians(10.0)])
"""Sides of the bins that are counted [m, m, rad]."""


@dataclass(frozen=True, slots=True)
class PoseEstimate:
    """What particles agree on.

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


class ParticleFilter:
    """Particles in the plane.

    Args:
        least: Number of particles at least.
        most: Number at most.
        error: Greatest error of their distribution (``kld_err``).
        quantile: Of the standard normal distribution (``kld_z``).
        slow: How fast the long memory of weights fades; 0 for no random particles.
        fast: How fast the short one does.
        random: Draws.

    Attributes:
        poses: x, y [m] and heading [rad], shape (n, 3).
        weights: They sum up to 1, shape (n,).
        converged: Whether all were within half a metre of their mean after the last resampling.
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
        self.least, self.most = least, max(most, least)
        self.error, self.quantile = error, quantile
        self.slow, self.fast = slow, fast
        self._random = random
        self.poses: Floats = np.zeros((self.most, 3))
        self.weights: Floats = np.full(self.most, 1.0 / self.most)
        self._long = self._short = 0.0
        self.converged = False

    def spread(self, mean: Floats, covariance: Floats) -> None:
        """Begin with a normal distribution: mean shape (3,), covariance (3, 3)."""
        values, axes = np.linalg.eigh(covariance)
        noise = self._random.standard_normal((self.most, 3)) * np.sqrt(np.maximum(values, 0.0))
        self.begin(np.asarray(mean) + noise @ axes.T)

    def begin(self, poses: Floats) -> None:
        """Begin with these particles, shape (n, 3)."""
        self.poses = np.ascontiguousarray(poses)
        self.weights = np.full(len(poses), 1.0 / len(poses))
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
        """How many particles of equal weight would tell as much."""
        return float(1.0 / (self.weights**2).sum())

    def resample(self, anywhere: Callable[[int], Floats]) -> None:
        """Draw new particles by their weights, as many as their spread needs.

        Args:
            anywhere: Draws so many poses from all over the map, shape (n, 3).
        """
        lost = max(0.0, 1.0 - self._short / self._long) if self._long > 0.0 else 0.0
        sums = np.cumsum(self.weights)
        # Evenly spaced draws vary less than independent ones; shuffled, any number of the first ones
        # is a fair sample.
        even = (np.arange(self.most) + self._random.random()) * (sums[-1] / self.most)
        drawn = np.searchsorted(sums, even, side="right")
        self._random.shuffle(drawn)
        poses = self.poses[np.minimum(drawn, len(self.poses) - 1)]
        if lost > 0.0:
            elsewhere = self._random.random(self.most) < lost
            poses[elsewhere] = anywhere(int(elsewhere.sum()))
            self._long = self._short = 0.0
        keys = _keys(poses)
        fresh = np.zeros(self.most, np.bool_)
        fresh[np.unique(keys, return_index=True)[1]] = True
        needed = self.needed(np.cumsum(fresh))
        enough = np.flatnonzero(np.arange(1, self.most + 1) > needed)
        count = int(enough[0]) + 1 if len(enough) else self.most
        self.poses = np.ascontiguousarray(poses[:count])
        self.weights = np.full(count, 1.0 / count)
        off = np.abs(self.poses[:, :2] - self.poses[:, :2].mean(axis=0))
        self.converged = bool(off.max() <= _CONVERGED)

    def needed(self, bins: Indices) -> Floats:
        """How many particles so many occupied bins need, between least and most."""
        k = np.maximum(np.asarray(bins, np.float64) - 1.0, 1e-9)
        share = 2.0 / (9.0 * k)
        x = 1.0 - share + np.sqrt(share) * self.quantile
        count = np.ceil(k / (2.0 * self.error) * x**3)
        bounded: Floats = np.clip(count, self.least, self.most)
        return np.where(np.asarray(bins) <= 1, float(self.most), bounded)

    def estimate(self) -> PoseEstimate:
        """What they agree on: the mean of the heaviest cluster."""
        labels = _clusters(_keys(self.poses))
        heaviest = int(np.bincount(labels, self.weights).argmax())
        chosen: Bools = labels == heaviest
        mean = _mean(self.poses[chosen], self.weights[chosen])
        return PoseEstimate(
            mean, _covariance(self.poses, self.weights), float(self.weights[chosen].sum())
        )


def _keys(poses: Floats) -> Indices:
    """A number for the bin of each pose, shape (n,)."""
    bins = np.floor(poses / _BIN).astype(np.int64) + (1 << 20)
    found: Indices = (bins[:, 0] << 42) | (bins[:, 1] << 21) | bins[:, 2]
    return found


_SIDES = [
    (x << 42) + (y << 21) + turn
    for x in (-1, 0, 1)
    for y in (-1, 0, 1)
    for turn in (-1, 0, 1)
    if x or y or turn
]


def _clusters(keys: Indices) -> Indices:
    """Which cluster each bin is in: those that touch are one, shape (n,)."""
    bins, inverse = np.unique(keys, return_inverse=True)
    label = dict.fromkeys(bins.tolist(), -1)
    count = 0
    for seed in label:
        if label[seed] >= 0:
            continue
        label[seed] = count
        front = [seed]
        while front:
            here = front.pop()
            for side in _SIDES:
                if label.get(here + side, 0) < 0:
                    label[here + side] = count
                    front.append(here + side)
        count += 1
    return np.fromiter(label.values(), np.intp, len(label))[inverse]


def _mean(poses: Floats, weights: Floats) -> Floats:
    share = weights / weights.sum()
    x, y = share @ poses[:, 0], share @ poses[:, 1]
    turn = math.atan2(share @ np.sin(poses[:, 2]), share @ np.cos(poses[:, 2]))
    return np.array([x, y, turn])


def _covariance(poses: Floats, weights: Floats) -> Floats:
    """Of place, and the circular variance of headings, as amcl gives it; shape (3, 3)."""
    share = weights / weights.sum()
    away = poses[:, :2] - share @ poses[:, :2]
    found = np.zeros((3, 3))
    found[:2, :2] = (away * share[:, None]).T @ away
    length = math.hypot(share @ np.sin(poses[:, 2]), share @ np.cos(poses[:, 2]))
    found[2, 2] = -2.0 * math.log(max(min(length, 1.0), 1e-12))
    return found
