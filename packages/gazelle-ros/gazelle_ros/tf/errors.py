"""Errors of transform look-ups; names and texts are tf2's."""

from __future__ import annotations

from gazelle_ros.base.errors import RosError


class TransformException(RosError):  # noqa: N818  # tf2's public name
    """Root of the errors of tf2."""


class LookupException(TransformException):
    """A frame does not exist, or the tree has a loop."""


class ConnectivityException(TransformException):
    """The frames are in different trees."""


class ExtrapolationException(TransformException):
    """The requested time is outside of what the buffer holds."""


class InvalidArgumentException(TransformException):
    """A frame's name is empty or starts with a slash, or a quaternion is not one."""


class TimeoutException(TransformException):
    """No answer came in time."""
