"""The node ``republish``: images of one transport in others (http://wiki.ros.org/image_transport)."""

from __future__ import annotations

import logging
from collections.abc import Sequence

from gazelle_ros.base.errors import RosError, did_you_mean
from gazelle_ros.base.parameter_values import fields_of, warn_of_unknown
from gazelle_ros.builtin.arguments import CallbackWork, parse_arguments, spin
from gazelle_ros.builtin.images.compression import CompressionSettings, compress, decompress
from gazelle_ros.builtin.tuned_settings import TunedSettings
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.node import Node
from gazelle_ros.publishing import Publisher

TRANSPORTS = ("raw", "compressed")
_USAGE = "republish IN_TRANSPORT [OUT_TRANSPORT] in:=IN_TOPIC out:=OUT_TOPIC"
_IMAGE, _COMPRESSED = sensor_msgs.msg.Image, sensor_msgs.msg.CompressedImage
_LOG = logging.getLogger("gazelle.ros.republish")


class ImageRepublisher(CallbackWork):
    """Images of the topic ``in`` on ``out``, each in its transports.

    Args:
        node: On the graph.
        incoming: Transport of ``in``.
        outgoing: Transport of ``out``; None for all.

    Raises:
        Error: There is no such transport, or a parameter of the compression is wrong.
    """

    def __init__(self, node: Node, incoming: str, outgoing: str | None = None) -> None:
        super().__init__(node)
        for each in (incoming, outgoing or incoming):
            if each not in TRANSPORTS:
                hint = f"{did_you_mean(each, TRANSPORTS)} {_USAGE}"
                raise RosError(f"images have no transport '{each}' here", hint=hint)
        source, target = node.resolve("in"), node.resolve("out")
        self.raw: Publisher | None = None
        self.compressed: CompressedPublisher | None = None
        if outgoing != "compressed":
            self.raw = node.advertise(target, _IMAGE, queue_size=1)
        if outgoing != "raw":
            self.compressed = CompressedPublisher(node, f"{target}/compressed")
        self._warned: set[str] = set()
        if incoming == "raw":
            node.subscribe(source, _IMAGE, self._take, 1)
        else:
            node.subscribe(f"{source}/compressed", _COMPRESSED, self._take_compressed, 1)

    def _take(self, image: sensor_msgs.msg.Image) -> None:
        if self.raw is not None:
            self.raw.publish(image)
        if self.compressed is not None:
            try:
                self.compressed.publish(image)
            except RosError as error:
                self._warn(error)

    def _take_compressed(self, message: sensor_msgs.msg.CompressedImage) -> None:
        try:
            image = decompress(message)
        except RosError as error:
            self._warn(error)
        else:
            self._take(image)

    def _warn(self, error: RosError) -> None:
        """Warn of images that are left out, once for each reason."""
        if str(error) not in self._warned:
            self._warned.add(str(error))
            _LOG.warning("%s", error)


class CompressedPublisher:
    """Publisher of compressed images, whose parameters lie below its topic.

    Args:
        node: On the graph.
        topic: To publish on.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node, topic: str) -> None:
        values = node.get_param(topic, {})
        values = values if isinstance(values, dict) else {}
        settings = CompressionSettings(**fields_of(CompressionSettings, values))
        self._publisher = node.advertise(topic, _COMPRESSED, queue_size=1)
        self._tuned = TunedSettings(node, settings, lambda _settings: None, topic)
        warn_of_unknown(topic, values, self._tuned.tunables)

    def publish(self, image: sensor_msgs.msg.Image) -> None:
        """Publish an image compressed, if there are subscribers.

        Raises:
            RosError: It cannot be compressed.
        """
        if self._publisher.has_subscribers and self._tuned.settings.enable:
            self._publisher.publish(compress(image, self._tuned.settings))


def main(arguments: Sequence[str]) -> int:
    """Publish images in other transports until shutdown; returns the exit code."""
    found = parse_arguments(arguments, "image_republisher", anonymous=True)
    if not 1 <= len(found.plain) <= 2:
        raise RosError("it takes one or two transports", hint=_USAGE)
    with found.start() as node:
        ImageRepublisher(node, *found.plain)
        return spin(node)
