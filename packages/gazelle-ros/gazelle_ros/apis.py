"""The frame around the XML-RPC methods of master and nodes: checked arguments, return triples.

Every method takes the caller's name first and returns ``[code, text, value]``; code 1 is
success, 0 failure, -1 a mistake of the caller
(http://wiki.ros.org/ROS/Master_Slave_APIs).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from gazelle_ros import names
from gazelle_ros.errors import MarshalError, report
from gazelle_ros.xmlrpc.server import UnknownMethodError
from gazelle_ros.xmlrpc.writing import check_value

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
        methods: Methods; missing and superfluous arguments are answered with -1.
    """

    def __init__(self, methods: dict[str, Method]) -> None:
        self._methods = methods

    def prepare(self, name: str, params: list[Any]) -> Callable[[], list[Any]]:
        """Check the arguments of a call; what does it is returned, and its answer never raises.

        Raises:
            UnknownMethodError: There is no such method.
        """
        method = self._methods.get(name)
        if method is None:
            raise UnknownMethodError(name)
        try:
            caller, arguments = _checked(method, params)
        except BadArgumentError as error:
            refusal = [-1, str(error), method.failure]
            return lambda: refusal
        return lambda: list(_call(name, method, caller, arguments))

    def dispatch(self, name: str, params: list[Any]) -> list[Any]:
        """Call a method.

        Raises:
            UnknownMethodError: There is no such method.
        """
        return self.prepare(name, params)()


def _checked(method: Method, params: list[Any]) -> tuple[str, list[Any]]:
    """Return the caller and the arguments.

    Raises:
        BadArgumentError: One is wrong.
    """
    if not params:
        raise BadArgumentError("missing required caller_id parameter")
    caller = params[0]
    if not isinstance(caller, str):
        raise BadArgumentError("caller_id must be a string")
    if len(params) - 1 != len(method.checks):
        raise BadArgumentError("Error: bad call arity")
    given = zip(method.checks, params[1:], strict=True)
    return caller, [check(label, value, caller) for (label, check), value in given]


def _call(name: str, method: Method, caller: str, arguments: list[Any]) -> Triple:
    try:
        return method.function(caller, *arguments)
    except BadArgumentError as error:
        return -1, f"Error: invalid arguments: {error}", method.failure
    except Exception as error:  # noqa: BLE001  # reported to the caller and the log
        if not isinstance(error, ValueError):
            report(f"{name} of {caller}", error)
        return 0, f"Internal failure: {error}", method.failure


def text(label: str, value: Any, _caller: str) -> str:
    """Return a string, empty or not."""
    if not isinstance(value, str):
        raise BadArgumentError(f"ERROR: parameter [{label}] must be a string")
    return value


def whole(label: str, value: Any, _caller: str) -> int:
    """Return an integer."""
    if not isinstance(value, int):
        raise BadArgumentError(f"ERROR: parameter [{label}] must be an integer")
    return value


def listing(label: str, value: Any, _caller: str) -> Sequence[Any]:
    """Return a list."""
    if not isinstance(value, list):
        raise BadArgumentError(f"ERROR: parameter [{label}] must be a list")
    return value


def given(label: str, value: Any, _caller: str) -> Any:
    """Return any value but nil."""
    if value is None:
        raise BadArgumentError(f"ERROR: parameter [{label}] must be specified")
    return value


def carriable(label: str, value: Any, caller: str) -> Any:
    """Return any value that an answer can hold."""
    try:
        check_value(given(label, value, caller))
    except MarshalError as error:
        raise BadArgumentError(f"Error: invalid arguments: {error}") from None
    return value


def key(label: str, value: Any, _caller: str) -> str:
    """Return a parameter's name, not resolved."""
    if not isinstance(value, str):
        raise BadArgumentError(f"ERROR: parameter [{label}] must be a string")
    if not value:
        raise BadArgumentError(f"ERROR: parameter [{label}] must be specified and non-empty")
    return value


def parameter(label: str, value: Any, caller: str) -> str:
    """Return a parameter's name, resolved for the caller."""
    return names.resolve(key(label, value, caller), caller)


def _filled(label: str, value: Any) -> str:
    if not isinstance(value, str) or not value:
        raise BadArgumentError(f"ERROR: parameter [{label}] must be a non-empty string")
    return value


def graph_name(label: str, value: Any, caller: str) -> str:
    """Return the name of a topic, service or node, resolved for the caller."""
    name = _filled(label, value)
    if any(letter in name for letter in (" ", "\t", "\n", ":")):
        raise BadArgumentError(f"ERROR: parameter [{label}] contains illegal chars")
    return names.resolve(name, caller)


def subgraph(label: str, value: Any, caller: str) -> str:
    """Return a namespace, resolved for the caller, with slashes at both ends."""
    space = text(label, value, caller)
    return names.as_namespace(names.resolve(space, caller)) if space else names.SEPARATOR


def message_type(label: str, value: Any, _caller: str) -> str:
    """Return ``package/Type`` or ``*``."""
    kind = _filled(label, value)
    if kind != names.ANY_TYPE and kind.count("/") != 1:
        raise BadArgumentError(f"ERROR: parameter [{label}] is not a valid package resource name")
    return kind


def api_uri(label: str, value: Any, _caller: str) -> str:
    """Return the URI of a node or service."""
    if not isinstance(value, str) or not value:
        raise BadArgumentError(f"ERROR: parameter [{label}] is not an XMLRPC URI")
    if not value.startswith(("http://", "rosrpc://")):
        raise BadArgumentError(f"ERROR: parameter [{label}] is not an RPC URI")
    return value


def api_uris(label: str, value: Any, caller: str) -> Sequence[str]:
    """Return a list of URIs of nodes."""
    return [api_uri(label, each, caller) for each in listing(label, value, caller)]
