"""Extended and unscented predictions of a Kalman filter.

The unscented one is that of Julier and Uhlmann with the weights of Wan and van der Merwe, "The unscented
Kalman filter for nonlinear estimation" (2000).
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.errors import Error
from gazelle.navigation.angles import wrapped_all
from gazelle.navigation.estimation.motion import (
    ANGLES,
    SIZE,
    moved,
    moved_with_jacobian,
)


@checked(Error, after=True)
class ExtendedPrediction:
    """Prediction of the covariance by the Jacobian of the motion."""

    def predict(self, state: Floats, covariance: Floats, seconds: float) -> tuple[Floats, Floats]:
        """Return state, shape (15,), and covariance, shape (15, 15), after a time [s]."""
        after, slope = moved_with_jacobian(state, seconds)
        return after, slope @ covariance @ slope.T


@checked(Error, after=True)
class UnscentedPrediction:
    """Prediction by 31 sigma points.

    Args:
        alpha: Spread of the points.
        kappa: Second parameter of their spread.
        beta: Of the distribution; 2 is best for a Gaussian one.

    Raises:
        Error: The points would not spread.
    """

    def __init__(self, alpha: float = 0.001, kappa: float = 0.0, beta: float = 2.0) -> None:
        self._spread = alpha * alpha * (SIZE + kappa)
        if not self._spread > 0.0:
            raise Error(f"alpha is not 0 and kappa greater than -{SIZE}, not {alpha} and {kappa}")
        self._weight = 0.5 / self._spread
        self._centre_weight = 1.0 - SIZE / self._spread + 1.0 - alpha * alpha + beta

    def predict(self, state: Floats, covariance: Floats, seconds: float) -> tuple[Floats, Floats]:
        """Return state, shape (15,), and covariance, shape (15, 15), after a time [s]."""
        root = math.sqrt(self._spread) * _root(covariance).T
        points = moved(np.concatenate((state[None], state + root, state - root)), seconds)
        centre = points[0]
        # Offsets from the centre, as the weights are large and of both signs: sums of the points
        # themselves would lose digits, and angles could not be averaged.
        offsets = points[1:] - centre
        offsets[:, ANGLES] = wrapped_all(offsets[:, ANGLES])
        mean = self._weight * offsets.sum(axis=0)
        spread = offsets - mean
        after = self._weight * spread.T @ spread + self._centre_weight * np.outer(mean, mean)
        return centre + mean, 0.5 * (after + after.T)


def _root(covariance: Floats) -> Floats:
    """Return a matrix L with L L' = covariance; negative eigenvalues count as zero."""
    try:
        return np.asarray(np.linalg.cholesky(covariance), np.float64)
    except np.linalg.LinAlgError:
        values, vectors = np.linalg.eigh(covariance)
        return np.asarray(vectors * np.sqrt(np.maximum(values, 0.0)))
