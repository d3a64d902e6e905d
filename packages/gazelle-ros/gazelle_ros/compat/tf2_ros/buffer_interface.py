"""Interface of all buffers, and registration of transforms and conversions of other types."""
# ruff: noqa: ARG002 - the interface names arguments that only buffers use

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from typing import Any, ClassVar

from gazelle_ros.compat.rospy.rostime import Duration
from gazelle_ros.msgs import std_msgs

_ZERO = Duration(0)
Callback = Callable[..., Any]


class NotImplementedException(Exception):  # noqa: N818  # tf2_ros's name
    """The interface was called, not a buffer."""

    def __init__(self) -> None:
        super().__init__("CanTransform or LookupTransform not implemented")


class TypeException(Exception):  # noqa: N818  # tf2_ros's name
    """No function transforms or converts a type.

    Args:
        errstr: The text.
    """

    def __init__(self, errstr: str) -> None:
        self.errstr = errstr
        super().__init__(errstr)


class TransformRegistration:
    """Registry of functions that transform values, by type; shared by all buffers."""

    _by_type: ClassVar[dict[Any, Callback]] = {}

    def add(self, key: Any, callback: Callback) -> None:
        """Transform values of a type by a function of value and ``TransformStamped``."""
        self._by_type[key] = callback

    def get(self, key: Any) -> Callback:
        """Return the function for a type.

        Raises:
            TypeException: There is none.
        """
        found = _for_type(self._by_type, key)
        if found is None:
            raise TypeException(f"Type {key} is not loaded or supported")
        return found

    def print_me(self) -> None:
        """Log the types."""
        from gazelle_ros.compat.rospy.logs import loginfo

        loginfo("%s", list(self._by_type))


class ConvertRegistration:
    """Registry of functions that convert values, by type; shared by all buffers."""

    _to_msg: ClassVar[dict[Any, Callback]] = {}
    _from_msg: ClassVar[dict[Any, Callback]] = {}
    _convert: ClassVar[dict[Any, Callback]] = {}

    def add_from_msg(self, key: Any, callback: Callback) -> None:
        """Register a function that makes values of a type from messages."""
        self._from_msg[key] = callback

    def add_to_msg(self, key: Any, callback: Callback) -> None:
        """Register a function that makes messages from values of a type."""
        self._to_msg[key] = callback

    def add_convert(self, key: Any, callback: Callback) -> None:
        """Convert values, the key being a pair of types, by a function."""
        self._convert[key] = callback

    def get_from_msg(self, key: Any) -> Callback:
        """Return the function that makes values of a type from messages.

        Raises:
            TypeException: There is none.
        """
        return self._get(self._from_msg, key)

    def get_to_msg(self, key: Any) -> Callback:
        """Return the function that makes messages from values of a type.

        Raises:
            TypeException: There is none.
        """
        return self._get(self._to_msg, key)

    def get_convert(self, key: Any) -> Callback:
        """Return the function that converts a pair of types.

        Raises:
            TypeException: There is none.
        """
        return self._get(self._convert, key)

    @staticmethod
    def _get(known: dict[Any, Callback], key: Any) -> Callback:
        found = _for_type(known, key)
        if found is None:
            raise TypeException(f"Type {key} is not loaded or supported")
        return found


def _for_type(known: dict[Any, Callback], key: Any) -> Callback | None:
    """Return the entry of a type, or of the message type of the same name."""
    if key in known:
        return known[key]
    name = getattr(key, "_type", None)
    if name is None:
        return None
    return next((known[each] for each in known if getattr(each, "_type", None) == name), None)


class BufferInterface:
    """Interface of all buffers."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(
        self,
        object_stamped: Any,
        target_frame: str,
        timeout: Any = _ZERO,
        new_type: Any = None,
    ) -> Any:
        """Transform a stamped value to another frame.

        Args:
            object_stamped: With ``header.frame_id`` and ``header.stamp``.
            target_frame: The frame.
            timeout: Longest wait for the transform.
            new_type: Convert the result to this type.

        Raises:
            TransformException: There is no transform; its class says why.
            TypeException: No function transforms the type; import ``tf2_geometry_msgs``.
        """
        apply = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout)
        result = apply(object_stamped, found)
        return result if new_type is None else convert(result, new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Any,
        fixed_frame: str,
        timeout: Any = _ZERO,
        new_type: Any = None,
    ) -> Any:
        """Transform a stamped value to another frame at another time; see `transform`."""
        apply = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        result = apply(object_stamped, found)
        return result if new_type is None else convert(result, new_type)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = _ZERO
    ) -> Any:
        """Return the transform from source to target at a time, 0 for the latest."""
        raise NotImplementedException

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = _ZERO,
    ) -> Any:
        """Return the transform from source at one time to target at another."""
        raise NotImplementedException

    def can_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = _ZERO
    ) -> Any:
        """Return whether there is a transform."""
        raise NotImplementedException

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = _ZERO,
    ) -> Any:
        """Return whether there is a transform from one time to another."""
        raise NotImplementedException


def Stamped(obj: Any, stamp: Any, frame_id: str) -> Any:  # noqa: N802  # tf2_ros's name
    """Return the value with a header."""
    obj.header = std_msgs.msg.Header(frame_id=frame_id, stamp=stamp)
    return obj


def convert(a: Any, b_type: Any) -> Any:
    """Return the value as another type.

    Raises:
        TypeException: No function converts the type.
    """
    known = ConvertRegistration()
    if type(a) is b_type:
        return deepcopy(a)
    try:
        return known.get_convert((type(a), b_type))(a)
    except TypeException:
        return known.get_from_msg(b_type)(known.get_to_msg(type(a))(a))
