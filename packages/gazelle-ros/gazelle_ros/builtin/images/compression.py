"""Images as JPEG and PNG and back, as ``compressed_image_transport`` does it."""

from __future__ import annotations

import io
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import numpy as np

from gazelle_ros.base.array_types import Pixels
from gazelle_ros.base.errors import RosError, did_you_mean
from gazelle_ros.base.tuned_fields import tunable
from gazelle_ros.compat.cv_bridge.core import CvBridge
from gazelle_ros.compat.cv_bridge.encodings import CvBridgeError, Encoding, encoding_of
from gazelle_ros.msgs import sensor_msgs

_FORMATS = ("jpeg", "png")
_GREY_MODES = {"L": "u1", "I;16": "u2"}


@dataclass(frozen=True, slots=True)
class CompressionSettings:
    """Parameters of ``compressed_image_transport``.

    Attributes:
        format: ``jpeg`` or ``png``.
        jpeg_quality: In percent.
        png_level: Of compression.
        enable: Whether images are published.
        jpeg_progressive: Whether a picture sharpens while it is loaded.
        jpeg_optimize: Whether a JPEG is made smaller, with more work.
        jpeg_restart_interval: Blocks between two marks from which a damaged JPEG can be read; 0 for none.
    """

    format: str = tunable("jpeg", description="Compression format: jpeg or png")
    jpeg_quality: int = tunable(80, 1, 100, "JPEG quality percentile")
    png_level: int = tunable(9, 1, 9, "PNG compression level")
    enable: bool = tunable(True, description="Enable image publishing")
    jpeg_progressive: bool = tunable(False, description="Enable progressive JPEG")
    jpeg_optimize: bool = tunable(False, description="Enable optimization of JPEG")
    jpeg_restart_interval: int = tunable(0, 0, 65535, "JPEG restart interval")

    def __post_init__(self) -> None:
        if self.format not in _FORMATS:
            hint = did_you_mean(self.format, _FORMATS)
            raise RosError(f"there is no compression '{self.format}'", hint=hint)


def compress(
    image: sensor_msgs.msg.Image, settings: CompressionSettings
) -> sensor_msgs.msg.CompressedImage:
    """Return a compressed image.

    Raises:
        RosError: Images of its encoding cannot be compressed so, or its data are no such image.
    """
    made = sensor_msgs.msg.CompressedImage(header=image.header)
    try:
        pixels = _plain(image, encoding_of(image.encoding))
    except CvBridgeError as error:
        raise RosError(str(error)) from error
    if pixels is None or (pixels.dtype.itemsize > 1 and settings.format != "png"):
        raise RosError(
            f"images of encoding '{image.encoding}' are not written as {settings.format}"
        )
    fill_compressed(made, pixels, image.encoding, settings)
    return made


def fill_compressed(
    message: sensor_msgs.msg.CompressedImage,
    pixels: Pixels,
    encoding: str,
    settings: CompressionSettings,
) -> None:
    """Set format and data of a message.

    Args:
        message: To fill.
        pixels: Grey (height, width), or red, green and blue (height, width, 3).
        encoding: Of the image before its compression.
        settings: Compression settings.

    Raises:
        RosError: Pillow is not installed.
    """
    written = io.BytesIO()
    options: dict[str, dict[str, Any]] = {
        "jpeg": {
            "quality": settings.jpeg_quality,
            "progressive": settings.jpeg_progressive,
            "optimize": settings.jpeg_optimize,
            "restart_marker_blocks": settings.jpeg_restart_interval,
        },
        "png": {"compress_level": settings.png_level},
    }
    pillow().fromarray(np.ascontiguousarray(pixels)).save(
        written, settings.format.upper(), **options[settings.format]
    )
    stored = "bgr8" if pixels.ndim > 2 else ""
    message.format = f"{encoding}; {settings.format} compressed {stored}".rstrip()
    message.data = written.getvalue()


def decompress(message: sensor_msgs.msg.CompressedImage) -> sensor_msgs.msg.Image:
    """Return an image in the encoding that it had; bgr8, mono8 or mono16 where that is not said.

    Raises:
        RosError: It cannot be read, or Pillow is not installed.
    """
    pixels = _read(bytes(message.data))
    said = message.format.partition(";")[0].strip() if ";" in message.format else ""
    bridge = CvBridge()
    if pixels.ndim == 2:
        plain = "mono8" if pixels.dtype.itemsize == 1 else "mono16"
        encoding = said if _holds(said, pixels.dtype, 1) else plain
        return bridge.cv2_to_imgmsg(pixels, encoding, message.header)
    encoding = said if _holds(said, pixels.dtype) else "bgr8"
    colours = bridge.imgmsg_to_cv2(bridge.cv2_to_imgmsg(pixels, "rgb8"), encoding)
    return bridge.cv2_to_imgmsg(colours, encoding, message.header)


def _plain(image: sensor_msgs.msg.Image, encoding: Encoding) -> Pixels | None:
    """Return grey, or red, green and blue; None if it is neither, of 8 or grey of 16 bits."""
    bridge = CvBridge()
    if encoding.channels == 1 and encoding.kind in {"u1", "u2"}:
        return bridge.imgmsg_to_cv2(image)
    if encoding.kind != "u1":
        return None
    if len(encoding.order) > 2:
        return bridge.imgmsg_to_cv2(image, "rgb8")
    return bridge.imgmsg_to_cv2(image)[..., ::-1] if encoding.channels == 3 else None


def _holds(name: str, kind: np.dtype[Any], channels: int | None = None) -> bool:
    """Return whether images of an encoding have this number of channels, or are colours."""
    try:
        found = encoding_of(name)
    except CvBridgeError:
        return False
    fits = len(found.order) > 2 if channels is None else found.channels == channels
    return fits and np.dtype(found.kind) == kind


def _read(data: bytes) -> Pixels:
    images = pillow()
    try:
        with images.open(io.BytesIO(data)) as picture:
            kind = _GREY_MODES.get(picture.mode)
            if kind is None:
                return np.asarray(picture.convert("RGB"), np.uint8)
            return np.asarray(picture, kind)
    except images.UnidentifiedImageError:  # its text differs each time
        raise RosError("a compressed image cannot be read: its format is unknown") from None
    except (images.DecompressionBombError, OSError, SyntaxError, ValueError) as error:
        raise RosError(f"a compressed image cannot be read: {error}") from error


def pillow() -> ModuleType:
    """Return Pillow's module of images.

    Raises:
        RosError: It is not installed.
    """
    try:
        from PIL import Image
    except ImportError:
        raise RosError(
            "compressed images and files of images need Pillow", hint="pip install pillow"
        ) from None
    return Image
