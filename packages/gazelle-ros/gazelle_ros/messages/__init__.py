"""ROS 1 messages and services, generated at run time from their definitions.

``load_message("std_msgs/String")`` returns a class with the interface of genpy's; classes are
generated and compiled on first use.
"""

from gazelle_ros.messages.base import Message, ServiceDefinition
from gazelle_ros.messages.errors import (
    DeserializationError,
    InvalidDefinitionError,
    MessageException,
    SerializationError,
    UnknownTypeError,
)
from gazelle_ros.messages.registry import (
    class_from_text,
    definitions,
    load_message,
    load_service,
    register,
)

__all__ = [
    "DeserializationError",
    "InvalidDefinitionError",
    "Message",
    "MessageException",
    "SerializationError",
    "ServiceDefinition",
    "UnknownTypeError",
    "class_from_text",
    "definitions",
    "load_message",
    "load_service",
    "register",
]
