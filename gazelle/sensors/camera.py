"""Cameras: colours and depths, drawn when somebody looks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bytes, Floats32, Worlds
from gazelle.description import Camera, Pose
from gazelle.engines import Engine
from gazelle.errors import EngineError
from gazelle.rendering import Frames, LiveScene, PinholeLens
from gazelle.rotations import multiply, rotate
from gazelle.sensors.lens_distortion import LensDistortion
from gazelle.states import restore_all, states_of
from gazelle.streams import Stream


@dataclass(frozen=True, slots=True)
class CameraImage:
    """One measurement of a camera.

    Attributes:
        stamp: Simulated time [ns].
        camera: What the file says about it.
        color: Red, green, blue, shape (..., height, width, 3), top row first.
        depth: Along the optical axis [m], infinite where nothing is, shape (..., height, width);
            None for a camera that measures none.
    """

    stamp: int
    camera: Camera
    color: Bytes
    depth: Floats32 | None = None


class CameraModel:
    """Measures one camera, or several that see at once, in every world.

    A measurement is bytes: of each camera the colours, then depths if it has any, so that its
    size is that of the pictures.

    Args:
        cameras: What the file says; more than one of a multicamera.
        depth: Whether depths are measured too.
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
        legacy: bool = True,
    ) -> None:
        if not cameras:
            raise EngineError("it has no <camera>")
        self.cameras, self.depth = tuple(cameras), depth
        self._scene, self._engine, self.link = scene, engine, link
        self._lenses = [PinholeLens.of_camera(camera) for camera in cameras]
        self.poses = [pose * camera.pose for camera in cameras]
        self._bends = [
            LensDistortion(camera, legacy=legacy) if any(camera.distortion) else None
            for camera in cameras
        ]
        self._noises = [
            Stream(seed, f"{name}/{number}", engine.nworld) for number in range(len(cameras))
        ]

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> Bytes:
        """Draw what is seen now, shape (n, bytes).

        Args:
            worlds: Which worlds; all if None.
            interval: Plays no part.
        """
        del interval
        place = self._engine.link_placement(self.link, worlds)
        parts: list[Bytes] = []
        for number, (lens, pose) in enumerate(zip(self._lenses, self.poses, strict=True)):
            at = place.position + rotate(place.quaternion, np.asarray(pose.position))
            turned = multiply(place.quaternion, np.asarray(pose.quaternion))
            want = ("color", "depth") if self.depth else ("color",)
            frames = self._scene.render(lens, at, turned, worlds, want=want)
            parts += self._bytes_of(number, frames, worlds)
        return np.concatenate(parts, axis=1)

    def _bytes_of(self, number: int, frames: Frames, worlds: Worlds | None) -> list[Bytes]:
        bend = self._bends[number]
        color = frames.color if bend is None else bend.apply(frames.color)
        color = self._noisy(number, color, worlds)
        count = len(color)
        parts = [color.reshape(count, -1)]
        if self.depth:
            parts.append(frames.depth.reshape(count, -1).view(np.uint8))
        return parts

    def _noisy(self, number: int, color: Bytes, worlds: Worlds | None) -> Bytes:
        """The same normal number on red, green and blue of a pixel, as Gazebo's shader adds it."""
        noise = self.cameras[number].noise
        if noise.type == "none" or (noise.mean == 0.0 and noise.stddev == 0.0):
            return color
        count, height, width, _ = color.shape
        drawn = self._noises[number].normal(height * width, worlds)
        added = 255.0 * (noise.mean + noise.stddev * drawn).reshape(count, height, width, 1)
        return np.asarray(np.clip(np.rint(color + added), 0.0, 255.0), np.uint8)

    def reading(self, values: Bytes, stamp: int) -> Any:
        """A measurement as arrays: a ``CameraImage``; of a multicamera a tuple of them."""
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
        """Use the random numbers of another seed, from their start."""
        for stream in self._noises:
            stream.reseed(seed, worlds)

    def reset(self, worlds: Worlds | None = None) -> None:
        """Nothing drifts."""

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Everything that changes, for a snapshot."""
        return states_of(self._streams())

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        restore_all(self._streams(), state)

    def _streams(self) -> dict[str, _StreamState]:
        return {str(number): _StreamState(stream) for number, stream in enumerate(self._noises)}


@dataclass(frozen=True, slots=True)
class _StreamState:
    """How far a stream has come."""

    stream: Stream

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Everything that changes."""
        return {"counters": self.stream.counters.copy(), "keys": self.stream.keys.copy()}

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        self.stream.counters[:] = state["counters"]
        self.stream.keys[:] = state["keys"]
