"""Errors of messages."""

from __future__ import annotations

from gazelle_ros.base.errors import RosError


class MessageException(RosError):  # noqa: N818  # the public name of genpy's class
    """Root of the errors about messages and their fields."""


class SerializationError(MessageException):
    """A field of a message holds a value outside its type."""


class DeserializationError(MessageException):
    """Bytes are not a message of the expected type."""


class InvalidDefinitionError(MessageException):
    """The text of a message, service or action is malformed."""


class UnknownTypeError(MessageException):
    """No definition of a message, service or action is known under this name."""
