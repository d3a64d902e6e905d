"""The frame around the XML-RPC methods of master and nodes: checked arguments, return triples.

Every method takes the caller's name first and returns ``[code, text, value]``; code 1 is
success, 0 failure, -1 a mistake of the caller
(http://wiki.ros.org/ROS/Master_Slave_APIs).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from gazelle.ros import names
from gazelle.ros.errors import report
from gazelle.ros.xmlrpc.server import UnknownMethodError

Triple = tuple[int, str, Any]
Check = Callable[[str, Any, str], Any]
"""Takes the parameter's name, its value and the caller; returns the value to use."""


class BadArgumentError(Exception):
    """An argument that the API does not accept; the text names it."""


@dataclass(frozen=True, slots=True)
class Method:
    """One method of an API."""

    function: Callable[..., Triple]
    failure: Any
    """The value that goes with an error code."""
    checks: tuple[tuple[str, Check], ...] = ()


class Api:
    """Methods by name.

    Args:
        methods: What there is; missing and superfluous arguments are answered with -1.
    """

    def __init__(self, methods: dict[str, Method]) -> None:
        self._methods = methods

    def dispatch(self, name: str, params: list[Any]) -> list[Any]:
        """Do a call.

        Raises:
            UnknownMethodError: There is no such method.
        """
        method = self._methods.get(name)
        if method is None:
            raise UnknownMethodError(name)
        return list(_call(name, method, params))


def _call(name: str, method: Method, params: list[Any]) -> Triple:
    if not params:
        return -1, "missing required caller_id parameter", method.failure
    caller = params[0]
    if not isinstance(caller, str):
        return -1, "caller_id must be a string", method.failure
    if len(params) - 1 != len(method.checks):
        return -1, "Error: bad call arity", method.failure
    try:
        arguments = [
            check(label, value, caller)
            for (label, check), value in zip(method.checks, params[1:], strict=True)
        ]
    except BadArgumentError as error:
        return -1, str(error), method.failure
    try:
        return method.function(caller, *arguments)
    except BadArgumentError as error:
        return -1, f"Error: invalid arguments: {error}", method.failure
    except Exception as error:  # noqa: BLE001  # the caller is told, and so is the log
        if not isinstance(error, ValueError):
            report(f"{name} of {caller}", error)
        return 0, f"Internal failure: {error}", method.failure


def anything(_label: str, value: Any, _caller: str) -> Any:
    """Any value."""
    return value


def text(label: str, value: Any, _caller: str) -> str:
    """A string, empty or not."""
    if not isinstance(value, str):
        raise BadArgumentError(f"ERROR: parameter [{label}] must be a string")
    return value


def whole(label: str, value: Any, _caller: str) -> int:
    """An integer."""
    if not isinstance(value, int):
        raise BadArgumentError(f"ERROR: parameter [{label}] must be an integer")
    return value


def listing(label: str, value: Any, _caller: str) -> Sequence[Any]:
    """A list."""
    if not isinstance(value, list):
        raise BadArgumentError(f"ERROR: parameter [{label}] must be a list")
    return value


def given(label: str, value: Any, _caller: str) -> Any:
    """Any value but nil."""
    if value is None:
        raise BadArgumentError(f"ERROR: parameter [{label}] must be specified")
    return value


def key(label: str, value: Any, _caller: str) -> str:
    """A parameter's name, not resolved."""
    if not isinstance(value, str):
        raise BadArgumentError(f"ERROR: parameter [{label}] must be a string")
    if not value:
        raise BadArgumentError(f"ERROR: parameter [{label}] must be specified and non-empty")
    return value


def parameter(label: str, value: Any, caller: str) -> str:
    """A parameter's name, resolved for the caller."""
    return names.resolve(key(label, value, caller), caller)


def _filled(label: str, value: Any) -> str:
    if not isinstance(value, str) or not value:
        raise BadArgumentError(f"ERROR: parameter [{label}] must be a non-empty string")
    return value


def graph_name(label: str, value: Any, caller: str) -> str:
    """The name of a topic, service or node, resolved for the caller."""
    name = _filled(label, value)
    if any(letter in name for letter in (" ", "\t", "\n", ":")):
        raise BadArgumentError(f"ERROR: parameter [{label}] contains illegal chars")
    return names.resolve(name, caller)


def subgraph(label: str, value: Any, caller: str) -> str:
    """A namespace, resolved for the caller, with slashes at both ends."""
    space = text(label, value, caller)
    return names.as_namespace(names.resolve(space, caller)) if space else names.SEPARATOR


def message_type(label: str, value: Any, _caller: str) -> str:
    """``package/Type`` or ``*``."""
    kind = _filled(label, value)
    if kind != names.ANY_TYPE and kind.count("/") != 1:
        raise BadArgumentError(f"ERROR: parameter [{label}] is not a valid package resource name")
    return kind


def api_uri(label: str, value: Any, _caller: str) -> str:
    """The URI of a node or service."""
    if not isinstance(value, str) or not value:
        raise BadArgumentError(f"ERROR: parameter [{label}] is not an XMLRPC URI")
    if not value.startswith(("http://", "rosrpc://")):
        raise BadArgumentError(f"ERROR: parameter [{label}] is not an RPC URI")
    return value


def api_uris(label: str, value: Any, caller: str) -> Sequence[str]:
    """A list of URIs of nodes."""
    return [api_uri(label, each, caller) for each in listing(label, value, caller)]
