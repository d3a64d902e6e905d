"""The nodes ``image_saver`` and ``extract_images``: images as files (http://wiki.ros.org/image_view)."""

from __future__ import annotations

import logging
import math
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from gazelle_ros import names
from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin.arguments import CallbackWork, run_node
from gazelle_ros.builtin.images.conversion import TRANSPORT_PARAMETERS
from gazelle_ros.builtin.images.files import NumberedNames, write_calibration, write_image
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import sensor_msgs, std_srvs
from gazelle_ros.node import Node

_LOG = logging.getLogger("gazelle.ros.images")


@dataclass(frozen=True, slots=True)
class SaverSettings:
    """Parameters of ``image_saver``.

    Attributes:
        filename_format: Names of the files, in the folder that the node runs in.
        encoding: Encoding that images are converted to before they are written.
        save_all_image: Whether each image is written, not only the next one after ``~save``.
        request_start_end: Whether images are written between ``~start`` and ``~end``.
        stamped_filename: Whether names have the stamp of the image before them.
    """

    filename_format: str = "left%04i.%s"
    encoding: str = "bgr8"
    save_all_image: bool = True
    request_start_end: bool = False
    stamped_filename: bool = False


@dataclass(frozen=True, slots=True)
class ExtractSettings:
    """Parameters of ``extract_images``.

    Attributes:
        filename_format: Names of the files, in the folder that the node runs in.
        sec_per_frame: Least time between two images that are written [s].
    """

    filename_format: str = "frame%04i.jpg"
    sec_per_frame: float = 0.1


class ImageSaver(CallbackWork):
    """Images of ``image`` as files, with the calibration of ``camera_info`` beside them.

    Services are ``~save`` for the next image, ``~start`` and ``~end``.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        super().__init__(node)
        self.settings = settings_of(node, SaverSettings, others=TRANSPORT_PARAMETERS)
        self._names = NumberedNames(self.settings.filename_format)
        self._camera: sensor_msgs.msg.CameraInfo | None = None
        self._once, self._started = False, not self.settings.request_start_end
        self._failed: set[str] = set()
        self._lock = threading.Lock()
        topic = node.resolve("image")
        kinds = sensor_msgs.msg
        info = names.namespace_of(topic) + "camera_info"
        node.subscribe(info, kinds.CameraInfo, self._take_camera, 1)
        node.subscribe(topic, kinds.Image, self._take, 1)
        node.serve("~save", std_srvs.srv.Empty, self._save_next)
        node.serve("~start", std_srvs.srv.Trigger, lambda _request: self._switch(started=True))
        node.serve("~end", std_srvs.srv.Trigger, lambda _request: self._switch(started=False))

    def _take_camera(self, camera: sensor_msgs.msg.CameraInfo) -> None:
        self._camera = camera

    def _save_next(self, _request: std_srvs.srv.EmptyRequest) -> list[Any]:
        self._once = True
        return []

    def _switch(self, *, started: bool) -> list[Any]:
        self._started = started
        return [True, ""]

    def _take(self, image: sensor_msgs.msg.Image) -> None:
        settings = self.settings
        always = settings.save_all_image or settings.request_start_end
        with self._lock:
            if not (self._once or (always and self._started)):
                return
            self._once = False
            path = self._names.next()
            if settings.stamped_filename:
                path = path.with_name(f"{image.header.stamp.to_sec():f}{path.name}")
            try:
                write_image(path, image, settings.encoding)
                if self._camera is not None:
                    write_calibration(path.with_suffix(".ini"), self._camera)
            except RosError as error:
                _warn_once(self._failed, error)
            else:
                self._names.count += 1


class ImageExtractor(CallbackWork):
    """Images of ``image`` as files, not more often than ``~sec_per_frame``.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        super().__init__(node)
        self.settings = settings_of(node, ExtractSettings, others=TRANSPORT_PARAMETERS)
        self._names = NumberedNames(self.settings.filename_format)
        self._last_ns = -math.inf
        self._failed: set[str] = set()
        node.subscribe("image", sensor_msgs.msg.Image, self._take, 1)

    def _take(self, image: sensor_msgs.msg.Image) -> None:
        now = self.node.clock.now()
        if now - self._last_ns < self.settings.sec_per_frame * SECOND:
            return
        self._last_ns = now
        try:
            write_image(self._names.next(), image, "bgr8")
        except RosError as error:
            _warn_once(self._failed, error)
        else:
            self._names.count += 1


def _warn_once(said: set[str], error: RosError) -> None:
    """Warn of an image that is not written, once for each reason."""
    if error.message not in said:
        said.add(error.message)
        _LOG.warning("%s", error)


def save_main(arguments: Sequence[str]) -> int:
    """Write images until shutdown; returns the exit code."""
    return run_node(arguments, "image_saver", ImageSaver, anonymous=True)


def extract_main(arguments: Sequence[str]) -> int:
    """Write images until shutdown; returns the exit code."""
    return run_node(arguments, "extract_images", ImageExtractor, anonymous=True)
