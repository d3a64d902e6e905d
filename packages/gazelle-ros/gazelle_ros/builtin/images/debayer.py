"""The nodelet ``image_proc/debayer``: colours and luminance of raw images (http://wiki.ros.org/image_proc)."""

from __future__ import annotations

import logging
from dataclasses import dataclass

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.tuned_fields import tunable
from gazelle_ros.builtin.images.conversion import QUEUE, TRANSPORT_PARAMETERS, ImageConversion
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.builtin.tuned_settings import TunedSettings
from gazelle_ros.compat.cv_bridge import CvBridge
from gazelle_ros.compat.cv_bridge.encodings import encoding_of
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.node import Node

_IMAGE = sensor_msgs.msg.Image
_LOG = logging.getLogger("gazelle.ros.images")


@dataclass(frozen=True, slots=True)
class DebayerSettings:
    """Parameters of ``image_proc/debayer``.

    Attributes:
        debayer: Method for mosaics: 0 bilinear; 1 to 3, edge aware and VNG, are bilinear here, too.
        queue_size: Images that wait.
    """

    debayer: int = tunable(0, 0, 3, "Debayering algorithm")
    queue_size: int = QUEUE


class Debayer(ImageConversion):
    """Raw images of ``image_raw`` on ``image_mono`` and ``image_color``.

    Mosaics become colours. Grey images are published on both topics, as the original does.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        settings = settings_of(node, DebayerSettings, others=TRANSPORT_PARAMETERS)
        self._tuned = TunedSettings(node, settings, _warn_of_methods)
        _warn_of_methods(settings)
        super().__init__(
            node,
            [("image_raw", _IMAGE)],
            [("image_mono", _IMAGE), ("image_color", _IMAGE)],
            self._convert_subscribed,
            queue_size=settings.queue_size,
        )

    def _convert_subscribed(
        self, image: sensor_msgs.msg.Image
    ) -> list[sensor_msgs.msg.Image | None]:
        mono, colour = self.outputs.subscribed
        return [mono_image(image) if mono else None, colour_image(image) if colour else None]


def mono_image(image: sensor_msgs.msg.Image) -> sensor_msgs.msg.Image:
    """Return the luminance of an image, of as many bits.

    Raises:
        RosError: The encoding says nothing of colours.
        CvBridgeError: The data are not an image of the encoding.
    """
    return image if encoding_of(image.encoding).order == "Y" else _as(image, "mono")


def colour_image(image: sensor_msgs.msg.Image) -> sensor_msgs.msg.Image:
    """Return an image in colours, of as many bits; grey ones and those in colours as they are.

    Raises:
        RosError: The encoding says nothing of colours.
        CvBridgeError: The data are not an image of the encoding.
    """
    return image if encoding_of(image.encoding).order else _as(image, "bgr")


def _as(image: sensor_msgs.msg.Image, kind: str) -> sensor_msgs.msg.Image:
    source = encoding_of(image.encoding)
    if not (source.order or source.name.startswith(("bayer", "yuv"))):
        raise RosError(
            f"images of encoding '{image.encoding}' have no colours",
            hint="cameras publish mono8, bgr8, bayer_rggb8 and the like",
        )
    target = f"{kind}{8 if source.kind == 'u1' else 16}"
    bridge = CvBridge()
    return bridge.cv2_to_imgmsg(bridge.imgmsg_to_cv2(image, target), target, image.header)


def _warn_of_methods(settings: DebayerSettings) -> None:
    if settings.debayer:
        _LOG.warning("mosaics are interpolated linearly, not by method %d", settings.debayer)
