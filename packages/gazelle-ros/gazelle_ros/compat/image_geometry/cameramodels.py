"""Cameras with and without a partner, from ``CameraInfo`` messages.

The projection is that of http://wiki.ros.org/image_pipeline/CameraInfo, the distortion OpenCV's.
"""
# ruff: noqa: N802, N803 - the names are image_geometry's

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle_ros.base.array_types import Floats
from gazelle_ros.base.errors import RosError, did_you_mean
from gazelle_ros.base.lenses import MOST_COEFFICIENTS, distort, undistort
from gazelle_ros.base.resampling import Interpolation, Resampling
from gazelle_ros.msgs import sensor_msgs

_MODELS = ("plumb_bob", "rational_polynomial")


def _from_pixels(intrinsic: Floats, pixels: Floats) -> Floats:
    """Return the rays of pixels at a depth of 1, shape (..., 3)."""
    homogeneous = np.concatenate((pixels, np.ones_like(pixels[..., :1])), axis=-1)
    return homogeneous @ np.linalg.inv(intrinsic).T


def _to_pixels(intrinsic: Floats, places: Floats) -> Floats:
    """Return the pixels of places at a depth of 1, shape (..., 2)."""
    return places @ intrinsic[:2, :2].T + intrinsic[:2, 2]


def _matrix(rows: int, columns: int, values: Sequence[float] | NDArray[Any]) -> Floats:
    return np.array(values, dtype=float).reshape(rows, columns)


class PinholeCameraModel:
    """One camera.

    Attributes:
        K: Its intrinsic matrix (3x3), for the raw image [px].
        D: Its distortion, (n, 1); None if it has none.
        R: Its rectification (3x3).
        P: Its projection (3x4), for the rectified image [px].
    """

    def __init__(self) -> None:
        self.K: Floats | None = None
        self.D: Floats | None = None
        self.R: Floats | None = None
        self.P: Floats = np.zeros((3, 4))
        self.full_K: Floats | None = None
        self.full_P: Floats = np.zeros((3, 4))
        self.width = self.height = 0
        self.binning_x = self.binning_y = 1
        self.raw_roi: Any = None
        self.tf_frame: str | None = None
        self.stamp: Any = None
        self._model = ""

    def fromCameraInfo(self, msg: sensor_msgs.msg.CameraInfo) -> None:
        """Set the values of a ``CameraInfo``."""
        self.full_K, self.R = _matrix(3, 3, msg.K), _matrix(3, 3, msg.R)
        self.D = _matrix(len(msg.D), 1, msg.D) if len(msg.D) else None
        self.full_P = _matrix(3, 4, msg.P)
        self.width, self.height = msg.width, msg.height
        self.binning_x, self.binning_y = max(1, msg.binning_x), max(1, msg.binning_y)
        self.raw_roi = msg.roi
        self.tf_frame, self.stamp = msg.header.frame_id, msg.header.stamp
        self._model = msg.distortion_model
        self.K, self.P = self._visible(self.full_K), self._visible(self.full_P)

    def _visible(self, full: Floats) -> Floats:
        """Return a matrix for the sent part of the image, and its binning."""
        seen = full.copy()
        seen[0, 2] -= self.raw_roi.x_offset
        seen[1, 2] -= self.raw_roi.y_offset
        seen[0] /= self.binning_x
        seen[1] /= self.binning_y
        return seen

    def rectifyPoint(self, uv_raw: Sequence[float]) -> tuple[float, float]:
        """Return the rectified pixel (u, v) of a raw one; NaN if the lens has none there.

        Raises:
            RosError: The camera is not calibrated, or its distortion model is unknown.
        """
        found = self.rectified(np.array(uv_raw, float))
        return float(found[0]), float(found[1])

    def unrectifyPoint(self, uv_rect: Sequence[float]) -> tuple[float, float]:
        """Return the raw pixel (u, v) of a rectified one.

        Raises:
            RosError: The camera is not calibrated, or its distortion model is unknown.
        """
        found = self.unrectified(np.array(uv_rect, float))
        return float(found[0]), float(found[1])

    def rectifyImage(
        self,
        raw: NDArray[Any],
        rectified: NDArray[Any],
        interpolation: int = Interpolation.CUBIC,
    ) -> None:
        """Fill an array with the rectified image.

        Args:
            raw: The image.
            rectified: Array of the same shape and type, which is filled.
            interpolation: OpenCV's number.

        Raises:
            RosError: The camera is not calibrated, or its distortion model is unknown.
        """
        rows, columns = raw.shape[:2]
        rectified[...] = self.rectification(columns, rows, Interpolation(interpolation)).apply(raw)

    def rectification(self, width: int, height: int, interpolation: Interpolation) -> Resampling:
        """Return what rectifies images of a size [px].

        Raises:
            RosError: The camera is not calibrated, or its distortion model is unknown.
        """
        places = np.stack(np.meshgrid(np.arange(width), np.arange(height)), axis=-1)
        raw = self.unrectified(places.astype(np.float64))
        return Resampling(raw[..., 0], raw[..., 1], (height, width), interpolation)

    def unrectified(self, pixels: Floats) -> Floats:
        """Return the raw pixels of rectified ones, shape (..., 2).

        Raises:
            RosError: The camera is not calibrated, or its distortion model is unknown.
        """
        raw, rotation, coefficients = self._calibration()
        rays = _from_pixels(self.P[:, :3], pixels) @ rotation  # R turns raw rays to rectified ones
        return _to_pixels(raw, distort(rays[..., :2] / rays[..., 2:], coefficients))

    def rectified(self, pixels: Floats) -> Floats:
        """Return the rectified pixels of raw ones, shape (..., 2); NaN where the lens has none.

        Raises:
            RosError: The camera is not calibrated, or its distortion model is unknown.
        """
        raw, rotation, coefficients = self._calibration()
        place = _from_pixels(raw, pixels)[..., :2]
        plain, found = undistort(place, coefficients)
        rays = np.concatenate((plain, np.ones_like(plain[..., :1])), axis=-1) @ rotation.T
        rectified = _to_pixels(self.P[:, :3], rays[..., :2] / rays[..., 2:])
        return np.where(found[..., None], rectified, math.nan)

    def _calibration(self) -> tuple[Floats, Floats, Sequence[float]]:
        """Return `K`, `R` and coefficients of the distortion."""
        if self.K is None or self.R is None or self.K[0, 0] == 0.0:
            raise RosError("the camera is not calibrated: its camera_info has no focal length")
        coefficients = [] if self.D is None else self.D[:, 0].tolist()
        if any(coefficients) and self._model not in _MODELS:
            hint = did_you_mean(self._model, _MODELS)
            raise RosError(
                f"images of the distortion model '{self._model}' are not rectified", hint=hint
            )
        if any(coefficients[MOST_COEFFICIENTS:]):
            raise RosError(
                "images of a tilted sensor (13th and 14th coefficient) are not rectified"
            )
        rotation = self.R if self.R.any() else np.eye(3)
        return self.K, rotation, coefficients[:MOST_COEFFICIENTS]

    def project3dToPixel(self, point: Sequence[float]) -> tuple[float, float]:
        """Return the rectified pixel (u, v) of a point in the camera's optical frame [m]."""
        x, y, w = self.P @ (point[0], point[1], point[2], 1.0)
        return (float(x / w), float(y / w)) if w else (math.nan, math.nan)

    def projectPixelTo3dRay(self, uv: Sequence[float]) -> tuple[float, float, float]:
        """Return the direction of length 1 of a rectified pixel's ray."""
        x = (uv[0] - self.cx()) / self.fx()
        y = (uv[1] - self.cy()) / self.fy()
        norm = math.sqrt(x * x + y * y + 1.0)
        return x / norm, y / norm, 1.0 / norm

    def getDeltaU(self, deltaX: float, Z: float) -> float:
        """Return the length in pixels of a length [m] along x at a depth [m]."""
        return math.inf if Z == 0 else self.fx() * deltaX / Z

    def getDeltaV(self, deltaY: float, Z: float) -> float:
        """Return the length in pixels of a length [m] along y at a depth [m]."""
        return math.inf if Z == 0 else self.fy() * deltaY / Z

    def getDeltaX(self, deltaU: float, Z: float) -> float:
        """Return the length [m] of pixels along u at a depth [m]."""
        return Z * deltaU / self.fx()

    def getDeltaY(self, deltaV: float, Z: float) -> float:
        """Return the length [m] of pixels along v at a depth [m]."""
        return Z * deltaV / self.fy()

    def fullResolution(self) -> tuple[int, int]:
        """Return width and height of the whole image [px]."""
        return self.width, self.height

    def intrinsicMatrix(self) -> Floats | None:
        """Return `K`."""
        return self.K

    def distortionCoeffs(self) -> Floats | None:
        """Return `D`."""
        return self.D

    def rotationMatrix(self) -> Floats | None:
        """Return `R`."""
        return self.R

    def projectionMatrix(self) -> Floats:
        """Return `P`."""
        return self.P

    def fullIntrinsicMatrix(self) -> Floats | None:
        """Return `K` for the whole image."""
        return self.full_K

    def fullProjectionMatrix(self) -> Floats:
        """Return `P` for the whole image."""
        return self.full_P

    def cx(self) -> float:
        """Return the centre's u [px]."""
        return float(self.P[0, 2])

    def cy(self) -> float:
        """Return the centre's v [px]."""
        return float(self.P[1, 2])

    def fx(self) -> float:
        """Return the focal length along u [px]."""
        return float(self.P[0, 0])

    def fy(self) -> float:
        """Return the focal length along v [px]."""
        return float(self.P[1, 1])

    def Tx(self) -> float:
        """Return the projection's translation along u [px m].

        It is minus focal length times baseline.
        """
        return float(self.P[0, 3])

    def Ty(self) -> float:
        """Return the projection's translation along v [px m]."""
        return float(self.P[1, 3])

    def fovX(self) -> float:
        """Return the horizontal field of view [rad]."""
        return 2 * math.atan(self.width / self.binning_x / (2 * self.fx()))

    def fovY(self) -> float:
        """Return the vertical field of view [rad]."""
        return 2 * math.atan(self.height / self.binning_y / (2 * self.fy()))

    def tfFrame(self) -> str | None:
        """Return its optical frame."""
        return self.tf_frame


class StereoCameraModel:
    """Two cameras beside each other.

    Attributes:
        left: The left one.
        right: The right one; its projection has the baseline.
    """

    def __init__(self) -> None:
        self.left, self.right = PinholeCameraModel(), PinholeCameraModel()

    def fromCameraInfo(self, left_msg: Any, right_msg: Any) -> None:
        """Set the values of two ``CameraInfo``."""
        self.left.fromCameraInfo(left_msg)
        self.right.fromCameraInfo(right_msg)

    def tfFrame(self) -> str | None:
        """Return the left camera's optical frame."""
        return self.left.tfFrame()

    def project3dToPixel(
        self, point: Sequence[float]
    ) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return the rectified pixels of a point, left and right."""
        return self.left.project3dToPixel(point), self.right.project3dToPixel(point)

    def projectPixelTo3d(
        self, left_uv: Sequence[float], disparity: float
    ) -> tuple[float, float, float]:
        """Return the point [m] of a left pixel and its disparity [px]; the origin if that is 0."""
        if disparity == 0:
            return 0.0, 0.0, 0.0
        depth = self.getZ(disparity)
        x = (left_uv[0] - self.left.cx()) / self.left.fx() * depth
        y = (left_uv[1] - self.left.cy()) / self.left.fy() * depth
        return x, y, depth

    def getZ(self, disparity: float) -> float:
        """Return the depth [m] of a disparity [px]."""
        return math.inf if disparity == 0 else -self.right.Tx() / disparity

    def getDisparity(self, Z: float) -> float:
        """Return the disparity [px] of a depth [m]."""
        return math.inf if Z == 0 else -self.right.Tx() / Z
