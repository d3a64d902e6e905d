"""Distortion of a picture by a lens: Brown's model in the two meanings that Gazebo has.

In Gazebo's own (legacy) mode places are in units of the longer side of the picture; in the other,
which is OpenCV's plumb_bob, in focal lengths. Where Gazebo moves pixels forwards and fills the gaps with
what is beside them, here each pixel finds by iteration where it comes from.
"""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Bytes
from gazelle.description import Camera
from gazelle.errors import EngineError
from gazelle.rendering import PinholeLens, PixelMeans
from gazelle_ros.base.lenses import distort, undistort

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
        origin, found = undistort(place, coefficients_of(camera))
        spot = origin * unit + middle - 0.5
        inside = found & (spot > -0.5).all(axis=-1)
        inside &= (spot < np.array([width - 0.5, height - 0.5])).all(axis=-1)
        self._means = PixelMeans.about(spot, inside, (height, width))

    def apply(self, color: Bytes) -> Bytes:
        """Return distorted pictures; black where nothing falls, shape (n, height, width, 3)."""
        return self._means.of(color.reshape(len(color), -1, 3))


def coefficients_of(camera: Camera) -> tuple[float, ...]:
    """Return a camera's coefficients in OpenCV's order."""
    k1, k2, k3, p1, p2 = camera.distortion
    return k1, k2, p1, p2, k3


def _crop_of(camera: Camera) -> float:
    """Return the scale of the picture after the rim of a barrel distortion is cropped."""
    middle = np.asarray(camera.distortion_center)
    ends = distort(np.array([[0.0, 0.0], [1.0, 1.0]]) - middle, coefficients_of(camera))
    scale = float((ends[1] - ends[0])[0])
    if scale < _LEAST_SCALE:
        raise EngineError("its distortion bends the whole picture into one point")
    return scale
