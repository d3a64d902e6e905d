"""The node ``image_view``: images that the page of a graph shows (http://wiki.ros.org/image_view)."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gazelle_ros.base.array_types import Pixels
from gazelle_ros.base.tuned_fields import tunable
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.images.conversion import TRANSPORT_PARAMETERS, ImageConversion
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.builtin.tuned_settings import TunedSettings
from gazelle_ros.compat.cv_bridge import CvBridge
from gazelle_ros.compat.cv_bridge.encodings import encoding_of
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.node import Node

_LOG = logging.getLogger("gazelle.ros.images")
_FULL_DEPTH_M = 10.0
_WINDOW_PARAMETERS = ("autosize", "window_name", "filename_format", "gui")


@dataclass(frozen=True, slots=True)
class ViewSettings:
    """Parameters of ``image_view``.

    Attributes:
        do_dynamic_scaling: Whether grey is stretched from an image's smallest to its greatest value.
        min_image_value: Value that is black, if it is less than the next one.
        max_image_value: Value that is white.
        colormap: Colours for grey, which are not here.
    """

    do_dynamic_scaling: bool = tunable(False, description="Do dynamic scaling about pixel values")
    min_image_value: float = tunable(0.0, 0.0, 1e9, "Minimum image value for scaling")
    max_image_value: float = tunable(0.0, 0.0, 1e9, "Maximum image value for scaling")
    colormap: int = tunable(-1, -1, 11, "colormap")


class ImageView(ImageConversion):
    """Images of ``image`` on ``~output``, as a window would show them.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        settings = settings_of(
            node, ViewSettings, others=(*TRANSPORT_PARAMETERS, *_WINDOW_PARAMETERS)
        )
        self._tuned = TunedSettings(node, settings, lambda _settings: None)
        kind = sensor_msgs.msg.Image
        super().__init__(
            node,
            [("image", kind)],
            [("~output", kind)],
            lambda image: [shown_image(self._tuned.settings, image)],
            queue_size=1,
        )
        _LOG.warning(
            "%s opens no window: `gazelle view` shows %s on its page",
            node.name,
            node.resolve("image"),
        )


def shown_image(settings: ViewSettings, image: sensor_msgs.msg.Image) -> sensor_msgs.msg.Image:
    """Return the colours in which an image is shown, of 8 bits.

    Depths, and grey of 16 bits, are stretched to the limits of the settings; without any, depths to
    10 m and grey to its type.

    Raises:
        CvBridgeError: It has no colours, or more than one channel without a meaning.
    """
    bridge = CvBridge()
    source = encoding_of(image.encoding)
    if source.channels != 1 or source.name.startswith("bayer"):
        return bridge.cv2_to_imgmsg(bridge.imgmsg_to_cv2(image, "bgr8"), "bgr8", image.header)
    grey = _stretched(settings, bridge.imgmsg_to_cv2(image))
    colours = np.repeat(grey[..., None], 3, axis=2)
    return bridge.cv2_to_imgmsg(colours, "bgr8", image.header)


def _stretched(settings: ViewSettings, pixels: Pixels) -> Pixels:
    """Return 8-bit grey values; values that are not finite are black."""
    low, high = settings.min_image_value, settings.max_image_value
    if settings.do_dynamic_scaling:
        finite = pixels[np.isfinite(pixels)].astype(np.float64)
        low, high = float(finite.min(initial=np.inf)), float(finite.max(initial=-np.inf))
    elif low >= high:
        if pixels.dtype == np.uint8:
            return pixels
        low = 0.0
        high = _FULL_DEPTH_M if pixels.dtype.kind == "f" else float(np.iinfo(pixels.dtype).max)
    scaled = (pixels.astype(np.float64) - low) / (high - low if high > low else 1.0) * 255.0
    grey: Pixels = np.clip(np.rint(np.where(np.isfinite(scaled), scaled, 0.0)), 0, 255)
    return grey.astype(np.uint8)


def main(arguments: Sequence[str]) -> int:
    """Publish images as they are shown until shutdown; returns the exit code."""
    return run_node(arguments, "image_view", ImageView, anonymous=True)
