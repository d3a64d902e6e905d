"""Values that camera plugins publish."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

from gazelle.array_types import Bytes, Floats32


@dataclass(frozen=True, slots=True)
class ImageValue:
    """A picture, in every world.

    Attributes:
        stamp: Simulated time [ns].
        pixels: Shape (nworld, height, width) or (nworld, height, width, channels).
        encoding: As ``sensor_msgs/image_encodings.h`` names it: rgb8, 32FC1, ...
    """

    stamp: int
    pixels: NDArray[Any]
    encoding: str


@dataclass(frozen=True, slots=True)
class CompressedImageValue:
    """The same, to be sent as JPEG.

    Attributes:
        stamp: Simulated time [ns].
        pixels: Grey or red, green, blue, shape (nworld, height, width[, 3]).
    """

    stamp: int
    pixels: Bytes


@dataclass(frozen=True, slots=True)
class CameraInfoValue:
    """Parameters of a camera's lens: the same in every world.

    Attributes:
        stamp: Simulated time [ns].
        width: [pixel].
        height: [pixel].
        distortion: k1, k2, p1, p2, k3 of plumb_bob.
        focal_length: [pixel].
        center: Column and row of the optical axis [pixel].
        baseline: To the left camera of a pair [m]; 0 for none.
    """

    stamp: int
    width: int
    height: int
    distortion: tuple[float, float, float, float, float]
    focal_length: float
    center: tuple[float, float]
    baseline: float = 0.0


@dataclass(frozen=True, slots=True)
class PixelPoints:
    """Points that pixels show, in the optical frame: x right, y down, z forward.

    Attributes:
        stamp: Simulated time [ns].
        points: [m], NaN for what is too near or too far, shape (nworld, height, width, 3).
        color: As the picture has it, shape (nworld, height, width, 3).
    """

    stamp: int
    points: Floats32
    color: Bytes
