"""Images as numpy arrays, converted between encodings.

Images in YUV and compressed ones are OpenCV's work, if ``cv2`` is installed.
"""

from __future__ import annotations

import sys
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle_ros.compat.cv_bridge.encodings import (
    CvBridgeError,
    Encoding,
    encoding_for,
    encoding_of,
    getCvType,
)
from gazelle_ros.compat.cv_bridge.mosaics import demosaic, grey
from gazelle_ros.msgs import sensor_msgs, std_msgs

__all__ = ["CvBridge", "CvBridgeError"]

Image = NDArray[Any]
_LEAST_MOSAIC = 3
_COMPRESSED_AS = {"jpg": "jpg", "jpeg": "jpg", "png": "png", "bmp": "bmp", "tiff": "tiff"}


class CvBridge:
    """Converts between ``Image`` messages and arrays of shape (height, width[, channels])."""

    def encoding_to_cvtype2(self, encoding: str) -> int:
        """Return OpenCV's number of an encoding's type."""
        return getCvType(encoding)

    def encoding_to_dtype_with_channels(self, encoding: str) -> tuple[str, int]:
        """Return NumPy's type of one value, such as ``uint8``, and the number of channels."""
        found = encoding_of(encoding)
        return np.dtype(found.kind).name, found.channels

    def cvtype2_to_dtype_with_channels(self, cvtype: int) -> tuple[str, int]:
        """Return type and channels of OpenCV's number of a type."""
        kinds = ("u1", "i1", "u2", "i2", "i4", "f4", "f8")
        return np.dtype(kinds[cvtype & 7]).name, (cvtype >> 3) + 1

    def dtype_with_channels_to_cvtype2(self, dtype: Any, n_channels: int) -> str:
        """Return the plain encoding of arrays, such as ``8UC3``."""
        return encoding_for(np.dtype(dtype), n_channels)

    def imgmsg_to_cv2(self, img_msg: Any, desired_encoding: str = "passthrough") -> Image:
        """Return the array of an ``Image``.

        Args:
            img_msg: The message.
            desired_encoding: Encoding of the array, such as ``bgr8``.

        Raises:
            CvBridgeError: There is no such conversion, or it needs OpenCV, which is not installed.
        """
        source = encoding_of(img_msg.encoding)
        image = _array(img_msg, source)
        if desired_encoding == "passthrough":
            return image
        return _converted(image, source, encoding_of(desired_encoding))

    def cv2_to_imgmsg(
        self, cvim: Image, encoding: str = "passthrough", header: std_msgs.msg.Header | None = None
    ) -> sensor_msgs.msg.Image:
        """Return the ``Image`` of an array.

        Args:
            cvim: The array.
            encoding: Encoding; by default the plain encoding of its type.
            header: The message's header.

        Raises:
            CvBridgeError: The array does not fit the encoding.
        """
        if not isinstance(cvim, np.ndarray | np.generic):
            raise TypeError("Your input type is not a numpy array")
        channels = 1 if cvim.ndim < 3 else cvim.shape[2]
        plain = encoding_for(cvim.dtype, channels)
        if encoding == "passthrough":
            encoding = plain
        elif (np.dtype(encoding_of(encoding).kind), encoding_of(encoding).channels) != (
            cvim.dtype.newbyteorder("="),
            channels,
        ):
            raise CvBridgeError(
                f"encoding specified as {encoding}, but image has incompatible type {plain}"
            )
        message = sensor_msgs.msg.Image()
        if header is not None:
            message.header = header
        message.height, message.width = cvim.shape[:2]
        message.encoding = encoding
        big = cvim.dtype.byteorder == ">" or (
            cvim.dtype.byteorder == "=" and sys.byteorder == "big"
        )
        message.is_bigendian = int(big)
        message.data = cvim.tobytes()
        message.step = len(message.data) // message.height if message.height else 0
        return message

    def compressed_imgmsg_to_cv2(
        self, cmprs_img_msg: Any, desired_encoding: str = "passthrough"
    ) -> Image:
        """Return the array of a ``CompressedImage``, as bgr8 unless wanted otherwise.

        Needs OpenCV.

        Raises:
            CvBridgeError: OpenCV is not installed, or it cannot read the image.
        """
        cv2 = _opencv("compressed images")
        data = np.frombuffer(bytes(cmprs_img_msg.data), np.uint8)
        image: Image | None = cv2.imdecode(data, cv2.IMREAD_UNCHANGED)
        if image is None:
            raise CvBridgeError(f"the image cannot be read; format: {cmprs_img_msg.format}")
        if desired_encoding == "passthrough":
            return image
        names = {2: "mono8", 3: "bgr8", 4: "bgra8"}
        source = encoding_of(names[2 if image.ndim < 3 else image.shape[2]])
        return _converted(image, source, encoding_of(desired_encoding))

    def cv2_to_compressed_imgmsg(self, cvim: Image, dst_format: str = "jpg") -> Any:
        """Return the ``CompressedImage`` of an array; needs OpenCV.

        Raises:
            CvBridgeError: OpenCV is not installed, or cannot write it.
        """
        cv2 = _opencv("compressed images")
        done, data = cv2.imencode(f".{_COMPRESSED_AS.get(dst_format, dst_format)}", cvim)
        if not done:
            raise CvBridgeError(f"the image cannot be written as {dst_format}")
        message = sensor_msgs.msg.CompressedImage()
        message.format, message.data = dst_format, data.tobytes()
        return message


def _array(message: sensor_msgs.msg.Image, source: Encoding) -> Image:
    """Return the pixels of a message, in this machine's byte order.

    A view where that is possible.
    """
    kind = np.dtype((">" if message.is_bigendian else "<") + source.kind)
    pixel = kind.itemsize * source.channels
    data = np.frombuffer(bytes(message.data), np.uint8)
    rows, across = message.height, message.width
    if rows and (message.step < across * pixel or data.size < rows * message.step):
        raise CvBridgeError(
            f"an image of {across}x{rows} pixels as {source.name} is more than its "
            f"{data.size} bytes with {message.step} a row"
        )
    lines = data[: rows * message.step].reshape(rows, message.step)[:, : across * pixel]
    image = np.ascontiguousarray(lines).view(kind)
    if source.channels > 1:
        image = image.reshape(rows, across, source.channels)
    return image if kind.isnative else image.astype(kind.newbyteorder("="))


def _converted(image: Image, source: Encoding, target: Encoding) -> Image:
    if (source.name, source.kind) == (target.name, target.kind):
        return image
    same_shape = (source.kind, source.channels) == (target.kind, target.channels)
    if same_shape and (not source.order or not target.order or source.order == target.order):
        return image
    if source.name.startswith("yuv"):
        return _by_opencv(image, source, target)
    if not target.order:
        raise CvBridgeError(f"there is no conversion from [{source.name}] to [{target.name}]")
    if source.name.startswith("bayer"):
        image, source = _demosaicked(image, source), encoding_of(f"rgb{source.name[10:]}")
    if not source.order:
        raise CvBridgeError(f"[{source.name}] is not a color format. but [{target.name}] is.")
    return _with_depth(_in_order(image, source, target), target)


def _demosaicked(image: Image, source: Encoding) -> Image:
    if min(image.shape) < _LEAST_MOSAIC:
        raise CvBridgeError(f"a mosaic has 3 x 3 pixels at least, not {image.shape}")
    return demosaic(image, source.name[6:10])


def _in_order(image: Image, source: Encoding, target: Encoding) -> Image:
    """Return the channels of the target, of the source's type."""
    if source.order == target.order:
        return image
    if source.order == "Y":
        return _coloured(image, target)
    if target.order == "Y":
        return grey(image[:, :, [source.order.index(each) for each in "rgb"]])
    return _reordered(image, source, target)


def _coloured(image: Image, target: Encoding) -> Image:
    """Convert grey to colours."""
    return _with_alpha(np.repeat(image[:, :, None], 3, axis=2), target)


def _reordered(image: Image, source: Encoding, target: Encoding) -> Image:
    if "a" in target.order and "a" not in source.order:
        places = [source.order.index(each) for each in target.order if each != "a"]
        return _with_alpha(image[:, :, places], target)
    return np.ascontiguousarray(image[:, :, [source.order.index(each) for each in target.order]])


def _with_alpha(colours: Image, target: Encoding) -> Image:
    if "a" not in target.order:
        return np.ascontiguousarray(colours)
    full = np.full((*colours.shape[:2], 1), np.iinfo(colours.dtype).max, colours.dtype)
    return np.concatenate((colours, full), axis=2)


def _opencv(what: str) -> ModuleType:
    try:
        import cv2  # type: ignore[import-not-found, unused-ignore]  # it need not be installed
    except ImportError:
        raise CvBridgeError(f"{what} need OpenCV: pip install opencv-python-headless") from None
    found: ModuleType = cv2
    return found


def _by_opencv(image: Image, source: Encoding, target: Encoding) -> Image:
    cv2: Any = _opencv(f"conversions from [{source.name}] to [{target.name}]")
    names = {"Y": "GRAY", "rgb": "RGB", "bgr": "BGR", "rgba": "RGBA", "bgra": "BGRA"}
    name = f"COLOR_YUV2{names.get(target.order, '')}_{'YUY2' if 'yuy2' in source.name else 'UYVY'}"
    if not hasattr(cv2, name):
        raise CvBridgeError(f"there is no conversion from [{source.name}] to [{target.name}]")
    return _with_depth(cv2.cvtColor(image, getattr(cv2, name)), target)


def _with_depth(image: Image, target: Encoding) -> Image:
    """Return the same image with values of another type; 8 bits become 16 by filling the range."""
    if image.dtype == np.dtype(target.kind):
        return image
    if image.dtype == np.uint8 and target.kind == "u2":
        return image.astype(np.uint16) * 257
    if image.dtype == np.uint16 and target.kind == "u1":
        return np.rint(image / 257.0).astype(np.uint8)
    return image.astype(target.kind)
