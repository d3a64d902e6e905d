"""Distortion of a picture by a lens: Brown's model in the two meanings that Gazebo has.

Brown, "Decentering Distortion of Lenses", Photogrammetric Engineering, 1966. With p the place of a
pixel from the centre of distortion and r its length, light that a pinhole sends to p falls on

    p (1 + k1 r^2 + k2 r^4 + k3 r^6) + (2 p1 x y + p2 (r^2 + 2 x^2), p1 (r^2 + 2 y^2) + 2 p2 x y)

In Gazebo's own (legacy) mode p is in units of the longer side of the picture; in the other, which
is OpenCV's plumb_bob, in focal lengths. Where Gazebo moves pixels forwards and fills the gaps with
what is beside them, here each pixel finds by iteration where it comes from.
"""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Bools, Bytes, Floats
from gazelle.description import Camera
from gazelle.errors import EngineError
from gazelle.rendering import PinholeLens, PixelMeans

Coefficients = tuple[float, float, float, float, float]

_ITERATIONS = 50
_SHARP = 1e-9
"""Accuracy of a pixel's origin, in units of p."""

_LEAST_SCALE = 1e-7


class LensDistortion:
    """Bends pictures of one camera.

    Args:
        camera: With k1, k2, k3, p1, p2.
        legacy: Whether they are in units of the longer side, not in focal lengths.

    Raises:
        EngineError: A cropped picture would have no size.
    """

    def __init__(self, camera: Camera, *, legacy: bool) -> None:
        lens = PinholeLens.of_camera(camera)
        width, height = lens.width, lens.height
        side = max(width, height)
        unit = float(side) if legacy else lens.focal
        columns, rows = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
        cx, cy = camera.distortion_center
        middle = np.array([cx * width, cy * height])
        place = (np.stack((columns, rows), axis=-1) - middle) / unit
        if legacy and camera.distortion[0] < 0.0:
            place = place * _crop_of(camera)
        origin, found = origin_of(place, camera.distortion)
        spot = origin * unit + middle - 0.5
        inside = found & (spot > -0.5).all(axis=-1)
        inside &= (spot < np.array([width - 0.5, height - 0.5])).all(axis=-1)
        self._means = PixelMeans.about(spot, inside, (height, width))

    def apply(self, color: Bytes) -> Bytes:
        """Return distorted pictures; black where nothing falls, shape (n, height, width, 3)."""
        return self._means.of(color.reshape(len(color), -1, 3))


def distort(place: Floats, coefficients: Coefficients) -> Floats:
    """Return the distorted positions of light from undistorted ones, shape (..., 2).

    Args:
        place: From the centre of distortion.
        coefficients: k1, k2, k3, p1, p2.
    """
    k1, k2, k3, p1, p2 = coefficients
    x, y = place[..., 0], place[..., 1]
    square = x * x + y * y
    radial = 1.0 + square * (k1 + square * (k2 + square * k3))
    return np.stack(
        (
            x * radial + p2 * (square + 2.0 * x * x) + 2.0 * p1 * x * y,
            y * radial + p1 * (square + 2.0 * y * y) + 2.0 * p2 * x * y,
        ),
        axis=-1,
    )


def origin_of(place: Floats, coefficients: Coefficients) -> tuple[Floats, Bools]:
    """Return the undistorted positions of light from distorted ones, and whether they were found.

    By Newton's iteration from the place itself, which finds the origin nearest to the centre.
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


def _crop_of(camera: Camera) -> float:
    """Return the scale of the picture after the rim of a barrel distortion is cropped."""
    middle = np.asarray(camera.distortion_center)
    ends = distort(np.array([[0.0, 0.0], [1.0, 1.0]]) - middle, camera.distortion)
    scale = float((ends[1] - ends[0])[0])
    if scale < _LEAST_SCALE:
        raise EngineError("its distortion bends the whole picture into one point")
    return scale
