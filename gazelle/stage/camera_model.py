"""One of Stage's cameras as a sensor."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bytes, Floats32, Worlds
from gazelle.description import Camera
from gazelle.sensors import CameraImage
from gazelle.stage.cameras import CameraPictures


class StageCameraModel:
    """Draws what a camera of Stage sees, colours and depths, in every world.

    A measurement is bytes, as those of ``CameraModel``: colours, then depths.

    Args:
        camera: Settings of the file.
        pictures: Images of some worlds, all if None, shape (n, 1, height, width, ...).
    """

    depth = True

    def __init__(self, camera: Camera, pictures: Callable[[Worlds | None], CameraPictures]) -> None:
        self.cameras, self._pictures = (camera,), pictures

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> Bytes:  # noqa: ARG002  nothing drifts
        """Render the present view, shape (n, bytes)."""
        seen = self._pictures(worlds)
        count = len(seen.color)
        color = np.ascontiguousarray(seen.color[..., :3], np.uint8).reshape(count, -1)
        depth = np.ascontiguousarray(seen.depth, np.float32).reshape(count, -1)
        return np.concatenate((color, depth.view(np.uint8)), axis=1)

    def reading(self, values: Bytes, stamp: int) -> CameraImage:
        """Return a measurement as arrays."""
        (camera,) = self.cameras
        shape = (*values.shape[:-1], camera.height, camera.width)
        colors = 3 * camera.height * camera.width
        raw = np.ascontiguousarray(values[..., colors:])
        depth: Floats32 = raw.view(np.float32).reshape(shape)
        return CameraImage(stamp, camera, values[..., :colors].reshape(*shape, 3), depth)

    def reseed(self, seed: int, worlds: Worlds | None = None) -> None:
        """Do nothing: there is no noise."""

    def reset(self, worlds: Worlds | None = None) -> None:
        """Do nothing: there is no noise."""

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return an empty state: there is no noise."""
        return {}

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Do nothing: there is no noise."""
