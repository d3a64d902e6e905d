"""Registry of conversion functions by type."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

Function = Callable[..., Any]
_to_numpy: dict[tuple[str, bool], Function] = {}
_from_numpy: dict[tuple[str, bool], Function] = {}


def _key(msgtype: Any, *, plural: bool) -> tuple[str, bool]:
    """Return the key of a type: its name, as messages of one type may have several classes."""
    return str(getattr(msgtype, "_type", msgtype)), plural


def converts_to_numpy(msgtype: Any, plural: bool = False) -> Callable[[Function], Function]:  # noqa: FBT001, FBT002  # ros_numpy's interface
    """Decorate the function that makes arrays of messages, or with `plural` of lists of them."""

    def decorate(function: Function) -> Function:
        _to_numpy[_key(msgtype, plural=plural)] = function
        return function

    return decorate


def converts_from_numpy(msgtype: Any, plural: bool = False) -> Callable[[Function], Function]:  # noqa: FBT001, FBT002  # ros_numpy's interface
    """Decorate the function that makes messages of arrays; see `converts_to_numpy`."""

    def decorate(function: Function) -> Function:
        _from_numpy[_key(msgtype, plural=plural)] = function
        return function

    return decorate


def numpify(msg: Any, *args: Any, **kwargs: Any) -> Any:
    """Return the array of a message, or of a list of messages of one type.

    Raises:
        ValueError: No function is registered, or the list is empty.
    """
    if msg is None:
        return None
    plural = isinstance(msg, list)
    if plural and not msg:
        raise ValueError("an empty list has no type to convert")
    kind = type(msg[0] if plural else msg)
    function = _to_numpy.get(_key(kind, plural=plural))
    if function is None:
        what = f"lists of {kind.__name__}" if plural else kind.__name__
        raise ValueError(f"Unable to convert message {what} - only supports {_names(_to_numpy)}")
    return function(msg, *args, **kwargs)


def msgify(msg_type: Any, numpy_obj: Any, *args: Any, **kwargs: Any) -> Any:
    """Return the message of an array.

    Args:
        msg_type: Its class, or a list with the class for a list of messages.
        numpy_obj: The array.
        args: Arguments of the type's function, such as an image's ``encoding``.
        kwargs: The same by name.

    Raises:
        ValueError: No function is registered.
    """
    plural = isinstance(msg_type, list | tuple)
    kind = msg_type[0] if plural else msg_type
    function = _from_numpy.get(_key(kind, plural=plural))
    if function is None:
        raise ValueError(f"Unable to build message {kind} - only supports {_names(_from_numpy)}")
    return function(numpy_obj, *args, **kwargs)


def _names(known: dict[tuple[str, bool], Function]) -> str:
    return ", ".join(f"[{name}]" if plural else name for name, plural in sorted(known))
