"""The nodelet ``image_proc/crop_decimate``: parts of images at a lower resolution (http://wiki.ros.org/image_proc)."""

from __future__ import annotations

import copy
from dataclasses import dataclass, replace

import numpy as np

from gazelle_ros.base.array_types import Pixels
from gazelle_ros.base.resampling import Interpolation, resize
from gazelle_ros.base.tuned_fields import tunable
from gazelle_ros.builtin.images.conversion import (
    QUEUE,
    TRANSPORT_PARAMETERS,
    ImageConversion,
    camera_topics,
)
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.builtin.tuned_settings import TunedSettings
from gazelle_ros.compat.cv_bridge import CvBridge
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.node import Node

_MOST_PX = 10_000
_MOSAIC = 2
"""Rows and columns of a mosaic's pattern."""


@dataclass(frozen=True, slots=True)
class CropSettings:
    """Parameters of ``image_proc/crop_decimate``.

    Attributes:
        decimation_x: Columns that become one.
        decimation_y: Rows that become one.
        x_offset: First column of the part.
        y_offset: First row of the part.
        width: Columns of the part; 0 for all that are left.
        height: Rows of the part; 0 for all that are left.
        interpolation: OpenCV's number: 0 nearest, 1 linear, 2 cubic, 3 area, 4 Lanczos.
        target_frame_id: Frame of the results; empty for that of the images.
        queue_size: Images that wait for their ``camera_info``.
    """

    decimation_x: int = tunable(1, 1, 16, "Number of pixels to decimate to one horizontally")
    decimation_y: int = tunable(1, 1, 16, "Number of pixels to decimate to one vertically")
    x_offset: int = tunable(0, 0, _MOST_PX, "X offset of the region of interest")
    y_offset: int = tunable(0, 0, _MOST_PX, "Y offset of the region of interest")
    width: int = tunable(0, 0, _MOST_PX, "Width of the region of interest")
    height: int = tunable(0, 0, _MOST_PX, "Height of the region of interest")
    interpolation: int = tunable(0, 0, 4, "Sampling algorithm")
    target_frame_id: str = ""
    queue_size: int = QUEUE


class CropDecimate(ImageConversion):
    """Parts of the images of ``camera`` as those of ``camera_out``.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        settings = settings_of(node, CropSettings, others=TRANSPORT_PARAMETERS)
        self._tuned = TunedSettings(node, settings, lambda _settings: None)
        super().__init__(
            node,
            camera_topics(node, "camera/image_raw"),
            camera_topics(node, "camera_out/image_raw"),
            lambda image, camera: cropped(self._tuned.settings, image, camera),
            queue_size=settings.queue_size,
        )


def cropped(
    settings: CropSettings, image: sensor_msgs.msg.Image, camera: sensor_msgs.msg.CameraInfo
) -> tuple[sensor_msgs.msg.Image, sensor_msgs.msg.CameraInfo]:
    """Return a part of an image at a lower resolution, and what it means for its camera.

    A mosaic that is decimated becomes colours, by the mean of each pattern's two green pixels.

    Args:
        settings: Part and decimation; a mosaic's pattern is not split.
        image: Of the camera.
        camera: Its calibration.

    Raises:
        ValueError: The part has no pixels, or a mosaic is decimated by an odd number.
        CvBridgeError: The data are not an image of the encoding.
    """
    mosaic = image.encoding.startswith("bayer")
    settings = _within(settings, image, step=_MOSAIC if mosaic else 1)
    rows = slice(settings.y_offset, settings.y_offset + settings.height)
    columns = slice(settings.x_offset, settings.x_offset + settings.width)
    pixels, encoding = CvBridge().imgmsg_to_cv2(image)[rows, columns], image.encoding
    across, down = settings.decimation_x, settings.decimation_y
    if mosaic and (across > 1 or down > 1):
        if across % _MOSAIC or down % _MOSAIC:
            raise ValueError("a mosaic is decimated by even numbers only")
        pixels, encoding = _patterns(pixels, encoding[6:10]), f"bgr{encoding[10:]}"
        across, down = across // _MOSAIC, down // _MOSAIC
    if across > 1 or down > 1:
        pixels = _decimated(pixels, down, across, Interpolation(settings.interpolation))
    header = copy.copy(image.header)
    header.frame_id = settings.target_frame_id or header.frame_id
    part = CvBridge().cv2_to_imgmsg(pixels, encoding, header)
    return part, _part_of_camera(settings, image, camera)


def _within(settings: CropSettings, image: sensor_msgs.msg.Image, step: int) -> CropSettings:
    """Return the part as far as the image has it, in steps of pixels."""
    x, y = settings.x_offset // step * step, settings.y_offset // step * step
    most_width, most_height = image.width - x, image.height - y
    if most_width < step or most_height < step:
        raise ValueError(f"the part begins at ({x}, {y}), beyond {image.width} x {image.height}")
    width = min(settings.width or most_width, most_width) // step * step
    height = min(settings.height or most_height, most_height) // step * step
    return replace(settings, x_offset=x, y_offset=y, width=width, height=height)


def _patterns(mosaic: Pixels, order: str) -> Pixels:
    """Return a pixel in blue, green and red for each pattern of a mosaic."""
    parts = [mosaic[row::2, column::2].astype(np.uint32) for row in range(2) for column in range(2)]
    first, second = (place for place, each in enumerate(order) if each == "g")
    green = (parts[first] + parts[second]) // 2
    planes = [parts[order.index("b")], green, parts[order.index("r")]]
    return np.stack(planes, axis=-1).astype(mosaic.dtype)


def _decimated(pixels: Pixels, down: int, across: int, interpolation: Interpolation) -> Pixels:
    height, width = pixels.shape[0] // down, pixels.shape[1] // across
    if not height or not width:
        raise ValueError(f"nothing is left of {pixels.shape[1]} x {pixels.shape[0]} pixels")
    if interpolation is Interpolation.NEAREST:
        return pixels[: height * down : down, : width * across : across]
    return resize(pixels, height, width, interpolation)


def _part_of_camera(
    settings: CropSettings, image: sensor_msgs.msg.Image, camera: sensor_msgs.msg.CameraInfo
) -> sensor_msgs.msg.CameraInfo:
    made = copy.deepcopy(camera)
    binning_x, binning_y = max(camera.binning_x, 1), max(camera.binning_y, 1)
    made.binning_x = binning_x * settings.decimation_x
    made.binning_y = binning_y * settings.decimation_y
    made.roi.x_offset += settings.x_offset * binning_x
    made.roi.y_offset += settings.y_offset * binning_y
    made.roi.width, made.roi.height = settings.width * binning_x, settings.height * binning_y
    if (settings.width, settings.height) != (image.width, image.height):
        made.roi.do_rectify = True
    made.header.frame_id = settings.target_frame_id or made.header.frame_id
    return made
