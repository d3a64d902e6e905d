"""Images and calibrations of cameras as files with numbered names."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.writing import replacing
from gazelle_ros.builtin.images.compression import pillow
from gazelle_ros.compat.cv_bridge import CvBridge
from gazelle_ros.compat.cv_bridge.encodings import CvBridgeError, encoding_of
from gazelle_ros.msgs import sensor_msgs

_SUFFIX = "jpg"


class NumberedNames:
    """Names of files, one after another.

    Args:
        pattern: As in C, with a place for the number, and maybe one for the suffix: ``left%04i.%s``.

    Raises:
        RosError: It has other places, or its first name has no suffix.
    """

    def __init__(self, pattern: str) -> None:
        self.pattern = pattern
        self.count = 0
        if not self.next().suffix:
            raise RosError(f"'{pattern}' names no kind of image", hint="such as frame%04i.jpg")

    def next(self) -> Path:
        """Return the next name, without counting it."""
        for values in ((self.count, _SUFFIX), (self.count,), ()):
            try:
                return Path(self.pattern % values)
            except (TypeError, ValueError):
                continue
        raise RosError(
            f"'{self.pattern}' is not a pattern of a file's name",
            hint="such as frame%04i.jpg or left%04i.%s",
        )


def write_image(path: Path, image: sensor_msgs.msg.Image, encoding: str) -> None:
    """Write an image; the suffix of the path says how.

    Args:
        path: The file.
        image: The image.
        encoding: Encoding that it is converted to before: grey or colours.

    Raises:
        RosError: It cannot be converted or written so, or Pillow is not installed.
    """
    try:
        target = encoding_of(encoding)
        pixels = CvBridge().imgmsg_to_cv2(image, encoding)
    except CvBridgeError as error:
        raise RosError(str(error)) from error
    if target.order.startswith("bgr"):
        pixels = pixels[..., [2, 1, 0, *range(3, target.channels)]]
    try:
        picture = pillow().fromarray(np.ascontiguousarray(pixels))
        with replacing(path) as draft:
            picture.save(draft)
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise RosError(
            f"an image of encoding '{encoding}' cannot be written: {error}", file=str(path)
        ) from error


def write_calibration(path: Path, camera: sensor_msgs.msg.CameraInfo) -> None:
    """Write a camera's calibration in the form of Videre's INI files, as ``image_saver`` does.

    Raises:
        RosError: The file cannot be written.
    """
    matrices = [
        ("camera matrix", camera.K, 3),
        ("distortion", camera.D, max(len(camera.D), 1)),
        ("rectification", camera.R, 3),
        ("projection", camera.P, 4),
    ]
    lines = ["# Camera intrinsics", "", "[image]", "", "width", str(camera.width), ""]
    lines += ["height", str(camera.height), "", "[camera]", ""]
    for name, values, columns in matrices:
        rows = [values[at : at + columns] for at in range(0, len(values), columns)]
        lines += [name, *(" ".join(f"{each:.5f}" for each in row) for row in rows), ""]
    try:
        with replacing(path) as draft:
            draft.write_text("\n".join(lines), encoding="utf-8")
    except OSError as error:
        raise RosError(f"the calibration cannot be written: {error}", file=str(path)) from error
