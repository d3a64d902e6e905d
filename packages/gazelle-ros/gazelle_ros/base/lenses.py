"""Distortion of images by lenses: Brown's model with OpenCV's coefficients.

Brown, "Decentering Distortion of Lenses", Photogrammetric Engineering, 1966. With p the place of a
pixel from the centre of distortion in focal lengths and r its length, light that a pinhole sends to p
falls on

    p (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6)
      + (2 p1 x y + p2 (r^2 + 2 x^2), p1 (r^2 + 2 y^2) + 2 p2 x y)
      + (s1 r^2 + s2 r^4, s3 r^2 + s4 r^4)

Coefficients are k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4; those left out are 0: five are the model
``plumb_bob`` of ROS, eight ``rational_polynomial``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle_ros.base.array_types import Bools, Floats

MOST_COEFFICIENTS = 12

_ITERATIONS = 50
_SHARP = 1e-9
"""Accuracy of an undistorted place, in focal lengths."""


def distort(place: Floats, coefficients: Sequence[float]) -> Floats:
    """Return the distorted places of light from undistorted ones, shape (..., 2).

    Args:
        place: From the centre of distortion, in focal lengths.
        coefficients: At most 12; see the module.
    """
    full = [*coefficients, *(0.0,) * (MOST_COEFFICIENTS - len(coefficients))]
    k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4 = full
    x, y = place[..., 0], place[..., 1]
    square = x * x + y * y
    radial = 1.0 + square * (k1 + square * (k2 + square * k3))
    if k4 or k5 or k6:
        radial = radial / (1.0 + square * (k4 + square * (k5 + square * k6)))
    found = np.stack(
        (
            x * radial + p2 * (square + 2.0 * x * x) + 2.0 * p1 * x * y,
            y * radial + p1 * (square + 2.0 * y * y) + 2.0 * p2 * x * y,
        ),
        axis=-1,
    )
    if s1 or s2 or s3 or s4:
        found[..., 0] += square * (s1 + square * s2)
        found[..., 1] += square * (s3 + square * s4)
    return found


def undistort(place: Floats, coefficients: Sequence[float]) -> tuple[Floats, Bools]:
    """Return the undistorted places of light from distorted ones, and whether they were found.

    By Newton's iteration from the place itself, which finds the origin nearest to the centre.

    Args:
        place: From the centre of distortion, in focal lengths, shape (..., 2).
        coefficients: At most 12; see the module.
    """
    guess = place.copy()
    step = 1e-6
    right, down = np.array([step, 0.0]), np.array([0.0, step])
    with np.errstate(all="ignore"):  # what runs away is not found
        for _ in range(_ITERATIONS):
            error = distort(guess, coefficients) - place
            if np.nanmax(np.abs(error), initial=0.0) < _SHARP:
                break
            along_x = (distort(guess + right, coefficients) - place - error) / step
            along_y = (distort(guess + down, coefficients) - place - error) / step
            a, c = along_x[..., 0], along_x[..., 1]
            b, d = along_y[..., 0], along_y[..., 1]
            turn = a * d - b * c
            move = np.stack(
                (d * error[..., 0] - b * error[..., 1], a * error[..., 1] - c * error[..., 0]), -1
            )
            guess = guess - np.clip(move / turn[..., None], -0.5, 0.5)
        error = distort(guess, coefficients) - place
        found = np.isfinite(error).all(axis=-1) & (np.abs(error).max(axis=-1) < 1e-6)
        # Beyond the fold light from farther out falls farther in: the wrong side of the lens.
        outward = distort(guess * 1.001, coefficients) - distort(guess, coefficients)
        found &= ((outward * guess).sum(axis=-1) >= 0.0) | (guess == 0.0).all(axis=-1)
    return np.where(found[..., None], guess, 0.0), found
