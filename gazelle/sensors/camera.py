"""Cameras: colours and depths, rendered on demand."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Bytes, Floats32, Worlds
from gazelle.description import Camera, Pose
from gazelle.engines import Engine
from gazelle.errors import EngineError, SimulationError
from gazelle.rendering import LiveScene
from gazelle.rotations import multiply, rotate
from gazelle.sensors.limits import check_interval, check_worlds
from gazelle.sensors.optics import Optics, optics_of
from gazelle.states import restore_all, states_of
from gazelle.streams import Stream


@dataclass(frozen=True, slots=True)
class CameraImage:
    """One measurement of a camera.

    Attributes:
        stamp: Simulated time [ns].
        camera: Settings of the file.
        color: Red, green, blue, shape (..., height, width, 3), top row first.
        depth: Along the optical axis [m], infinite where nothing is, shape (..., height, width);
            None for a camera that measures none.
    """

    stamp: int
    camera: Camera
    color: Bytes
    depth: Floats32 | None = None


@checked(SimulationError, after=True)
class CameraModel:
    """Measures one camera, or several that see at once, in every world.

    A measurement is bytes: of each camera the colours, then depths if it has any, so that its
    size is that of the pictures.

    Args:
        cameras: Settings of the file; several for a multicamera.
        depth: Whether depths are measured too.
        wide: Whether they are wide-angle cameras.
        legacy: Whether the coefficients of a distortion are meant as Gazebo's own.
        scene: Draws.
        engine: Knows the motion.
        link: Scoped name of the link it is on.
        pose: The sensor frame in the link frame.
        seed: The run's seed.
        name: Scoped name of the sensor; names its random streams.

    Raises:
        EngineError: There is no camera, or no such lens.
    """

    def __init__(
        self,
        cameras: Sequence[Camera],
        scene: LiveScene,
        engine: Engine,
        link: str,
        pose: Pose,
        seed: int,
        name: str,
        *,
        depth: bool,
        wide: bool = False,
        legacy: bool = True,
    ) -> None:
        if not cameras:
            raise EngineError("it has no <camera>")
        self.cameras, self.depth = tuple(cameras), depth
        self._scene, self._engine, self.link = scene, engine, link
        self._make_optics = partial(optics_of, wide=wide, legacy=legacy)
        self._optics = [self._make_optics(camera) for camera in cameras]
        self._previews: dict[int, Optics] = {}
        self.poses = [pose * camera.pose for camera in cameras]
        self._noises = [
            Stream(seed, f"{name}/{number}", engine.nworld) for number in range(len(cameras))
        ]

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> Bytes:
        """Render the present view, shape (n, bytes).

        Args:
            worlds: Worlds; all if None.
            interval: Time since the last measurement [s], for sensors with drifts.
        """
        check_interval(interval)
        check_worlds(worlds, self._engine.nworld)
        parts: list[Bytes] = []
        for number, optics in enumerate(self._optics):
            color, depth = self._render(number, optics, worlds, depth=self.depth)
            color = self._noisy(number, color, worlds)
            parts.append(color.reshape(len(color), -1))
            if self.depth:
                parts.append(depth.reshape(len(color), -1).view(np.uint8))
        return np.concatenate(parts, axis=1)

    def preview(self, worlds: Worlds, width: int) -> Bytes:
        """Return the first camera's present view without its noise, shape (n, rows, columns, 3).

        Args:
            worlds: Worlds.
            width: Columns at most [pixel].
        """
        camera = self.cameras[0]
        columns = min(camera.width, width)
        rows = max(1, round(camera.height * columns / camera.width))
        if width not in self._previews:
            small = replace(camera, width=columns, height=rows)
            self._previews[width] = self._make_optics(small)
        return self._render(0, self._previews[width], worlds, depth=False)[0]

    def _render(
        self, number: int, optics: Optics, worlds: Worlds | None, *, depth: bool
    ) -> tuple[Bytes, Floats32]:
        place, pose = self._engine.links[self.link].placement(worlds), self.poses[number]
        at = place.position + rotate(place.quaternion, np.asarray(pose.position))
        turned = multiply(place.quaternion, np.asarray(pose.quaternion))
        return optics.render(self._scene, at, turned, worlds, depth=depth)

    def _noisy(self, number: int, color: Bytes, worlds: Worlds | None) -> Bytes:
        """Add the same normal number to red, green and blue of a pixel, as Gazebo does."""
        noise = self.cameras[number].noise
        if noise.type == "none" or (noise.mean == 0.0 and noise.stddev == 0.0):
            return color
        count, height, width, _ = color.shape
        drawn = self._noises[number].normal(height * width, worlds)
        added = 255.0 * (noise.mean + noise.stddev * drawn).reshape(count, height, width, 1)
        return np.asarray(np.clip(np.rint(color + added), 0.0, 255.0), np.uint8)

    def reading(self, values: Bytes, stamp: int) -> Any:
        """Return a measurement as arrays: a ``CameraImage``; of a multicamera a tuple of them."""
        images, begin = [], 0
        for camera in self.cameras:
            shape = (*values.shape[:-1], camera.height, camera.width)
            pixels = camera.height * camera.width
            color = values[..., begin : begin + 3 * pixels].reshape(*shape, 3)
            begin += 3 * pixels
            depth: Floats32 | None = None
            if self.depth:
                raw = np.ascontiguousarray(values[..., begin : begin + 4 * pixels])
                depth, begin = raw.view(np.float32).reshape(shape), begin + 4 * pixels
            images.append(CameraImage(stamp, camera, color, depth))
        return images[0] if len(images) == 1 else tuple(images)

    def reseed(self, seed: int, worlds: Worlds | None = None) -> None:
        """Set the seed of the random numbers and start them again."""
        for stream in self._noises:
            stream.reseed(seed, worlds)

    def reset(self, worlds: Worlds | None = None) -> None:
        """Do nothing: nothing drifts."""

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state, for a snapshot."""
        return states_of(self._streams())

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        restore_all(self._streams(), state)

    def _streams(self) -> dict[str, _StreamState]:
        return {str(number): _StreamState(stream) for number, stream in enumerate(self._noises)}


@dataclass(frozen=True, slots=True)
class _StreamState:
    """State of a stream."""

    stream: Stream

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state."""
        return {"counters": self.stream.counters.copy(), "keys": self.stream.keys.copy()}

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self.stream.counters[:] = state["counters"]
        self.stream.keys[:] = state["keys"]
