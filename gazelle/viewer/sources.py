"""Sources of films and pictures: a running file, a recording, a bag, a trained policy."""

from __future__ import annotations

import io
from abc import abstractmethod
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from gazelle.array_types import Picture
from gazelle.errors import RosError, did_you_mean
from gazelle.simulation import Simulation
from gazelle.viewer.filming import FilmCamera
from gazelle.viewer.limits import picture_count
from gazelle_ros.base.closing import Closeable
from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import sensor_msgs

IMAGES = ("sensor_msgs/Image", "sensor_msgs/CompressedImage")


class FilmSource(Closeable):
    """A source of pictures over time."""

    @abstractmethod
    def advance(self, seconds: float) -> bool:
        """Advance to a time after the start [s]; False when it is over."""

    @abstractmethod
    def render(self) -> Picture:
        """Return the present picture, shape (height, width, 3)."""

    def close(self) -> None:
        """Release resources."""


class SimulationSource(FilmSource):
    """A simulation that runs.

    Args:
        simulation: Runs, and is closed at the end.
        camera: Looks at it.
    """

    def __init__(self, simulation: Simulation, camera: FilmCamera) -> None:
        self._simulation, self._camera = simulation, camera

    def advance(self, seconds: float) -> bool:
        """Run; it is never over."""
        ahead = seconds - self._simulation.time
        if ahead > 0.5 * self._simulation.engine.time_step:
            self._simulation.run(ahead)
        return True

    def render(self) -> Picture:
        """Return the camera's picture."""
        return self._camera.render()

    def close(self) -> None:
        """Free the simulation."""
        self._simulation.close()


class RecordingSource(FilmSource):
    """A recorded run, done again.

    Args:
        path: File of ``Simulation.record``.
        camera: Makes what looks at it.

    Raises:
        SimulationError: The file is not a recording.
    """

    def __init__(self, path: Path, camera: Callable[[Simulation], FilmCamera]) -> None:
        from gazelle.simulation import Replay

        self._replay = Replay(path)
        self._start = self._replay.simulation.time
        self._camera = camera(self._replay.simulation)

    def advance(self, seconds: float) -> bool:
        """Replay everything up to a time."""
        simulation, step = self._replay.simulation, self._replay.simulation.engine.time_step
        while (left := self._start + seconds - simulation.time) > 0.5 * step:
            if not self._replay.step(max(1, round(left / step))):
                return False
        return True

    def render(self) -> Picture:
        """Return the camera's picture."""
        return self._camera.render()

    def close(self) -> None:
        """Free the simulation."""
        self._replay.close()


class PolicySource(FilmSource):
    """A trained policy in its task.

    Args:
        path: Folder of a run, or a ``policy.npz``.
        options: As ``gazelle.training.playback.Playback`` takes them.
    """

    def __init__(self, path: Path, **options: Any) -> None:
        from gazelle.training.playback import Playback

        self._playback = Playback(path, **options)
        self._steps = 0

    def advance(self, seconds: float) -> bool:
        """Run the policy; it is never over."""
        while (self._steps + 0.5) * self._playback.period < seconds:
            self._playback.step()
            self._steps += 1
        return True

    def render(self) -> Picture:
        """Return the environment's picture."""
        return self._playback.render()

    def close(self) -> None:
        """Free the environment."""
        self._playback.close()


class BagSource(FilmSource):
    """The images of one topic of a bag.

    Args:
        path: The bag.
        topic: Of images or compressed ones; the first if None.

    Raises:
        RosError: There is no such topic, or it has no image.
    """

    def __init__(self, path: Path, topic: str | None = None) -> None:
        from gazelle_ros.bags import Bag

        self._bag = Bag(str(path))
        found = self._bag.get_type_and_topic_info().topics
        known = [name for name, about in found.items() if about.msg_type in IMAGES]
        if topic is None and known:
            topic = known[0]
        if topic not in known:
            self._bag.close()
            raise RosError(
                f"'{path.name}' has no images" + (f" on '{topic}'" if topic else ""),
                hint=did_you_mean(topic or "", known) if known else "it has no topic of images",
            )
        self._messages = self._bag.read_messages(topics=[topic])
        self._now = next(self._messages)
        self._next = next(self._messages, None)
        self._start = _stamp(self._now)

    def advance(self, seconds: float) -> bool:
        """Advance to the last image before a time."""
        while self._next is not None and _stamp(self._next) <= self._start + seconds:
            self._now, self._next = self._next, next(self._messages, None)
        return self._next is not None

    def render(self) -> Picture:
        """Return the image."""
        return picture_of(self._now.message)

    def close(self) -> None:
        """Close the bag."""
        self._bag.close()


def pictures_of(source: FilmSource, seconds: float | None, period: float) -> Iterator[Picture]:
    """Yield the first picture of a source, and one after each period [s], until an end time."""
    yield source.render()
    count = None if seconds is None else picture_count(seconds, period)
    number = 0
    while count is None or number < count:
        number += 1
        more = source.advance(number * period)
        yield source.render()
        if not more:
            return


def picture_of(message: sensor_msgs.msg.Image | sensor_msgs.msg.CompressedImage) -> Picture:
    """Return the colours of a ``sensor_msgs`` Image or CompressedImage, (height, width, 3).

    Depths are grey, near ones dark.

    Raises:
        RosError: Its encoding is not known, or its data are no such image.
    """
    if hasattr(message, "format"):
        return _decompressed(bytes(message.data))
    kind = _ENCODINGS.get(message.encoding)
    if kind is None:
        raise RosError(
            f"images of encoding '{message.encoding}' cannot be drawn",
            hint=f"known are {', '.join(_ENCODINGS)}",
        )
    dtype, channels, order = kind
    width = message.width * channels * np.dtype(dtype).itemsize
    if len(message.data) != message.height * message.step or not 0 < width <= message.step:
        raise RosError(
            f"an image of {message.width} x {message.height} pixels of encoding "
            f"'{message.encoding}' and rows of {message.step} bytes cannot have "
            f"{len(message.data)} bytes"
        )
    rows = np.frombuffer(bytes(message.data), np.uint8).reshape(message.height, message.step)
    values = np.ascontiguousarray(rows[:, :width]).view(
        np.dtype(dtype).newbyteorder(">" if message.is_bigendian else "<")
    )
    pixels = values.reshape(message.height, message.width, channels)[..., order]
    return _as_bytes(pixels)


def _decompressed(data: bytes) -> Picture:
    try:
        with Image.open(io.BytesIO(data)) as image:
            return np.asarray(image.convert("RGB"), np.uint8)
    except (Image.DecompressionBombError, OSError, SyntaxError, ValueError) as error:
        raise RosError(f"a compressed image cannot be read: {error}") from error


def _as_bytes(pixels: Any) -> Picture:
    if pixels.dtype.kind == "f" or pixels.dtype.itemsize > 1:
        far = np.asarray(pixels, np.float64)
        far = np.where(np.isfinite(far), far, 0.0)
        most = float(far.max()) or 1.0
        return np.asarray(np.clip(far / most, 0.0, 1.0) * 255.0, np.uint8)
    return np.ascontiguousarray(pixels, np.uint8)


# Type, channels, and which of them are red, green and blue.
_ENCODINGS: dict[str, tuple[str, int, list[int]]] = {
    "rgb8": ("u1", 3, [0, 1, 2]),
    "rgba8": ("u1", 4, [0, 1, 2]),
    "bgr8": ("u1", 3, [2, 1, 0]),
    "bgra8": ("u1", 4, [2, 1, 0]),
    "mono8": ("u1", 1, [0, 0, 0]),
    "8UC1": ("u1", 1, [0, 0, 0]),
    "8UC3": ("u1", 3, [2, 1, 0]),
    "mono16": ("u2", 1, [0, 0, 0]),
    "16UC1": ("u2", 1, [0, 0, 0]),
    "32FC1": ("f4", 1, [0, 0, 0]),
}


def _stamp(read: Any) -> float:
    """Return the time at which a message was recorded [s]."""
    seconds: float = read.timestamp.to_nsec() / SECOND
    return seconds


def is_run(path: Path) -> bool:
    """Return whether a path is of a trained policy: a run's folder, or ``policy.npz``."""
    if path.suffix == ".npz":
        return path.is_file()
    return path.is_dir() and (path / "config.json").is_file()
