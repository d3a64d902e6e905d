"""Images of topics as pictures for web pages, one stream a request."""

from __future__ import annotations

import io
import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from gazelle_ros.base.array_types import Pixels
from gazelle_ros.base.errors import RosError
from gazelle_ros.base.resampling import Interpolation, resize
from gazelle_ros.builtin.images.compression import decompress, pillow
from gazelle_ros.compat.cv_bridge import CvBridge, CvBridgeError
from gazelle_ros.compat.cv_bridge.encodings import encoding_of
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.node import Node

JPEG_QUALITY, PNG_LEVEL = 95, 3
LARGEST: Final = 10_000
"""Greatest width or height that a request may ask for [px]."""


@dataclass(frozen=True, slots=True)
class Picture:
    """An encoded image.

    Attributes:
        data: Contents of a file.
        kind: Its type, such as ``image/jpeg``.
        stamp: Time of the message [ns].
    """

    data: bytes
    kind: str
    stamp: int


@dataclass(frozen=True, slots=True)
class StreamRequest:
    """Query of a request.

    Attributes:
        topic: Of the images.
        width: Of the pictures [px]; -1 for that of the images.
        height: Likewise.
        quality: Of JPEG in percent, or the compression level of PNG.
        invert: Whether pictures are turned by 180 degrees.
        transport: ``raw`` or ``compressed``.
    """

    topic: str
    width: int = -1
    height: int = -1
    quality: int = -1
    invert: bool = False
    transport: str = "raw"

    @classmethod
    def read(cls, query: Mapping[str, str]) -> StreamRequest:
        """Read a query.

        Raises:
            RosError: A value is wrong.
        """
        numbers = {}
        for name in ("width", "height", "quality"):
            try:
                numbers[name] = int(query.get(name, "-1"))
            except ValueError:
                raise RosError(f"'{name}' is a number, not '{query[name]:.60}'") from None
        for name in ("width", "height"):
            if not (numbers[name] == -1 or 0 < numbers[name] <= LARGEST):
                raise RosError(f"'{name}' is 1 to {LARGEST}, not {numbers[name]}")
        return cls(
            query.get("topic", ""),
            **numbers,
            invert="invert" in query,
            transport=query.get("default_transport", "raw"),
        )


class NewestPicture:
    """Newest picture of a topic.

    Args:
        node: On the graph.
        topic: To subscribe to.
        kind: Class of its messages.
        encode: Makes a picture of a message; a RosError, CvBridgeError or ValueError ends the stream.

    Attributes:
        fault: Reason for the end of the pictures; "" while there may be more.
    """

    def __init__(self, node: Node, topic: str, kind: Any, encode: Callable[[Any], Picture]) -> None:
        self._encode = encode
        self._news = threading.Condition()
        self._message: Any = None
        self.fault = ""
        self._subscriber = node.subscribe(topic, kind, self._take, 1)

    def close(self) -> None:
        """End the subscription."""
        self._subscriber.close()

    def wait(self, seconds: float) -> Picture | None:
        """Return the next picture; None if there is none within a time."""
        with self._news:
            self._news.wait_for(lambda: self._message is not None, seconds)
            message, self._message = self._message, None
        if message is None:
            return None
        try:
            return self._encode(message)
        except (RosError, CvBridgeError, ValueError) as error:
            self.fault = str(error)
            return None

    def _take(self, message: Any) -> None:
        with self._news:
            self._message = message
            self._news.notify_all()


def picture_stream(node: Node, kind: str, asked: StreamRequest) -> NewestPicture:
    """Return the pictures of a topic, as ``jpeg`` or ``png``.

    Raises:
        RosError: The topic has no name that could be one, or Pillow is not installed.
    """
    pillow()
    packed = asked.transport == "compressed"
    image, compressed = sensor_msgs.msg.Image, sensor_msgs.msg.CompressedImage
    topic = f"{asked.topic}/compressed" if packed else asked.topic

    def encode(message: Any) -> Picture:
        return _picture(decompress(message) if packed else message, kind, asked)

    return NewestPicture(node, topic, compressed if packed else image, encode)


def compressed_stream(node: Node, asked: StreamRequest) -> NewestPicture:
    """Return the compressed images of a topic as they are."""

    def encode(message: sensor_msgs.msg.CompressedImage) -> Picture:
        kind = "png" if "png" in message.format else "jpeg"
        if kind == "jpeg" and "jpeg" not in message.format and "jpg" not in message.format:
            raise RosError(f"images of the format '{message.format}' are not sent to pages")
        return Picture(bytes(message.data), f"image/{kind}", message.header.stamp.to_nsec())

    topic = f"{asked.topic}/compressed"
    return NewestPicture(node, topic, sensor_msgs.msg.CompressedImage, encode)


def _picture(image: sensor_msgs.msg.Image, kind: str, asked: StreamRequest) -> Picture:
    """Return an image as a picture of the size and quality asked for.

    Raises:
        CvBridgeError: It has no colours.
    """
    pixels = _colours(image, alpha=kind == "png")
    if asked.invert:
        pixels = pixels[::-1, ::-1]
    height, width = (
        there if size < 0 else size
        for size, there in zip((asked.height, asked.width), pixels.shape, strict=False)
    )
    if (height, width) != pixels.shape[:2]:
        pixels = resize(np.ascontiguousarray(pixels), height, width, Interpolation.LINEAR)
    options = {"quality": asked.quality if 0 <= asked.quality <= 100 else JPEG_QUALITY}
    if kind == "png":
        options = {"compress_level": asked.quality if 0 <= asked.quality <= 9 else PNG_LEVEL}
    written = io.BytesIO()
    pillow().fromarray(np.ascontiguousarray(pixels)).save(written, kind.upper(), **options)
    return Picture(written.getvalue(), f"image/{kind}", image.header.stamp.to_nsec())


def _colours(image: sensor_msgs.msg.Image, *, alpha: bool) -> Pixels:
    """Return grey (height, width), or red, green, blue and perhaps alpha, of 8 bits.

    Floats are scaled so that the greatest is white.
    """
    bridge, source = CvBridge(), encoding_of(image.encoding)
    if source.kind.startswith("f"):
        values = np.nan_to_num(bridge.imgmsg_to_cv2(image), posinf=0.0, neginf=0.0)
        most = float(values.max(initial=0.0))
        grey = values * (255.0 / most) if most > 0.0 else values
        return np.clip(np.rint(grey), 0.0, 255.0).astype(np.uint8)
    if alpha and image.encoding in {"rgba8", "bgra8"}:
        return bridge.imgmsg_to_cv2(image, "rgba8")
    return bridge.imgmsg_to_cv2(image, "rgb8")
