"""Camera lenses, independent of the camera's pose."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from gazelle.argument_checks import checked
from gazelle.errors import EngineError

if TYPE_CHECKING:
    from gazelle.description import Camera

MAX_PIXELS = 64 * 2**20


@checked(EngineError)
@dataclass(frozen=True, slots=True)
class PinholeLens:
    """A pinhole: straight lines stay straight.

    Attributes:
        width: Columns of pixels.
        height: Rows of pixels.
        horizontal_fov: Horizontal field of view [rad].
        near: Near clipping distance along the axis [m].
        far: Far clipping distance along the axis [m].
        vertical_fov: Vertical field of view [rad]; None for square pixels.

    Raises:
        EngineError: There can be no such picture.
    """

    width: int = 640
    height: int = 480
    horizontal_fov: float = 1.047
    near: float = 0.02
    far: float = 1000.0
    vertical_fov: float | None = None

    def __post_init__(self) -> None:
        """Check what a user gave."""
        if self.width < 1 or self.height < 1 or self.width * self.height > MAX_PIXELS:
            raise EngineError(
                f"a picture has between 1 and {MAX_PIXELS} pixels, not {self.width} x {self.height}"
            )
        for fov in (self.horizontal_fov, self.vertical_fov):
            if fov is not None and not 0.0 < fov < math.pi:
                raise EngineError(
                    f"the field of view of a camera is between 0 and 180 degrees, not "
                    f"{math.degrees(fov):g}"
                )
        if not 0.0 < self.near < self.far < math.inf:
            raise EngineError(
                "a camera sees from a distance above zero to a greater one, not from "
                f"{self.near:g} to {self.far:g} m"
            )

    @classmethod
    def of_camera(cls, camera: Camera) -> PinholeLens:
        """Return the lens of a description's camera."""
        return cls(camera.width, camera.height, camera.horizontal_fov, camera.near, camera.far)

    @property
    def focal(self) -> float:
        """Focal length along rows, and along columns too where pixels are square [pixel]."""
        return self.width / (2.0 * math.tan(self.horizontal_fov / 2.0))

    @property
    def focals(self) -> tuple[float, float]:
        """Focal lengths along rows and columns [pixel]."""
        if self.vertical_fov is None:
            return self.focal, self.focal
        return self.focal, self.height / (2.0 * math.tan(self.vertical_fov / 2.0))

    @property
    def row(self) -> tuple[float, float, float, float, float, float]:
        """Row of numbers for the rasteriser; the optical axis goes through the middle."""
        return (*self.focals, self.width / 2.0, self.height / 2.0, self.near, self.far)
