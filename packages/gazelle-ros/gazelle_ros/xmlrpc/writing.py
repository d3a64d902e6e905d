"""Values to XML-RPC documents."""

from __future__ import annotations

import base64
import re
import sys
from collections.abc import Mapping, Sequence
from typing import Any

from gazelle_ros.errors import MarshalError, MarshalRangeError, MarshalTypeError

INT_MIN, INT_MAX = -(2**31), 2**31 - 1
_DEEPEST = 100
_PIECE = 64 * 1024
# What XML 1.0 cannot carry, whatever the escape; a lone surrogate cannot be UTF-8.
_FORBIDDEN = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff\ud800-\udfff]")
_SPECIAL = re.compile("[&<>\r]")
_ESCAPES = {"&": "&amp;", "<": "&lt;", ">": "&gt;", "\r": "&#13;"}


def write_call(method: str, params: Sequence[Any]) -> bytes:
    """Write the document of a method call.

    Raises:
        MarshalError: XML-RPC cannot carry one of the parameters.
    """
    out = [
        "<?xml version='1.0'?>\n<methodCall><methodName>",
        escape(method),
        "</methodName><params>",
    ]
    _write_params(params, out)
    out.append("</params></methodCall>")
    return "".join(out).encode()


def write_response(value: Any) -> bytes:
    """Write the document of an answer.

    Raises:
        MarshalError: XML-RPC cannot carry the value.
    """
    out = ["<?xml version='1.0'?>\n<methodResponse><params>"]
    _write_params((value,), out)
    out.append("</params></methodResponse>")
    return "".join(out).encode()


def write_fault(code: int, text: str) -> bytes:
    """Write the document of a failure."""
    out = ["<?xml version='1.0'?>\n<methodResponse><fault>"]
    _write(
        {"faultCode": code, "faultString": _FORBIDDEN.sub("?", text)},
        out,
        0,
    )
    out.append("</fault></methodResponse>")
    return "".join(out).encode()


def escape(text: str) -> str:
    """Return text escaped for XML.

    Raises:
        MarshalError: It holds control characters.
    """
    if len(text) > _PIECE:  # piece by piece: meanwhile no other thread runs
        pieces = range(0, len(text), _PIECE)
        return "".join(escape(text[begin : begin + _PIECE]) for begin in pieces)
    if text.isascii() and text.isalnum():
        return text
    if _FORBIDDEN.search(text):
        raise MarshalError(f"XML cannot carry the control characters of {text[:60]!r}")
    return _SPECIAL.sub(lambda match: _ESCAPES[match[0]], text)


def check_value(value: Any) -> None:
    """Check that `write_call` can encode `value`.

    Raises:
        MarshalError: It cannot.
    """
    _write(value, [], 0)


def _write_params(params: Sequence[Any], out: list[str]) -> None:
    for value in params:
        out.append("<param>")
        _write(value, out, 0)
        out.append("</param>")


def _write(value: Any, out: list[str], depth: int) -> None:
    if depth > _DEEPEST:
        raise MarshalError(f"nested deeper than {_DEEPEST}")
    kind = type(value)
    if kind is str:
        out.append(f"<value><string>{escape(value)}</string></value>")
    elif kind is bool:
        out.append(f"<value><boolean>{int(value)}</boolean></value>")
    elif kind is int:
        _write_int(value, out)
    elif kind is float:
        out.append(f"<value><double>{value!r}</double></value>")
    elif kind is list or kind is tuple:
        _write_array(value, out, depth)
    elif kind is dict:
        _write_struct(value, out, depth)
    else:
        _write_other(value, out, depth)


def _write_int(value: int, out: list[str]) -> None:
    if not INT_MIN <= value <= INT_MAX:
        raise MarshalRangeError(f"int exceeds XML-RPC limits: {value} does not fit 32 bits")
    out.append(f"<value><int>{int(value)}</int></value>")


def _write_array(value: Sequence[Any], out: list[str], depth: int) -> None:
    out.append("<value><array><data>")
    for item in value:
        _write(item, out, depth + 1)
    out.append("</data></array></value>")


def _write_struct(value: Mapping[Any, Any], out: list[str], depth: int) -> None:
    out.append("<value><struct>")
    for key, item in value.items():
        if not isinstance(key, str):
            raise MarshalTypeError(
                f"dictionary key must be string, not {type(key).__name__} {key!r}"
            )
        out.append(f"<member><name>{escape(key)}</name>")
        _write(item, out, depth + 1)
        out.append("</member>")
    out.append("</struct></value>")


def _write_other(value: Any, out: list[str], depth: int) -> None:
    """Write subclasses of the plain types, bytes, dates, and numpy's numbers."""
    if value is None:
        raise MarshalTypeError("XML-RPC has no value for None")
    if isinstance(value, (bytes, bytearray, memoryview)):
        out.append(f"<value><base64>{base64.b64encode(value).decode()}</base64></value>")
    elif isinstance(value, int):
        _write_int(value, out)
    elif isinstance(value, (str, float)):
        _write(str(value) if isinstance(value, str) else float(value), out, depth)
    elif isinstance(value, Mapping):
        _write_struct(value, out, depth)
    elif isinstance(value, (list, tuple)):
        _write_array(value, out, depth)
    else:
        _write_foreign(value, out, depth)


def _write_foreign(value: Any, out: list[str], depth: int) -> None:
    """Write the standard library's wrappers, dates, and numpy's numbers and arrays."""
    if _is_standard(value, "Binary"):
        _write_other(value.data, out, depth)
    elif _is_standard(value, "DateTime"):
        out.append(f"<value><dateTime.iso8601>{escape(value.value)}</dateTime.iso8601></value>")
    elif hasattr(value, "strftime"):
        stamp = value.strftime("%Y%m%dT%H:%M:%S")
        out.append(f"<value><dateTime.iso8601>{stamp}</dateTime.iso8601></value>")
    elif hasattr(value, "tolist"):
        _write(value.tolist(), out, depth + 1)
    else:
        raise MarshalTypeError(f"XML-RPC cannot carry a {type(value).__name__}")


def _is_standard(value: Any, name: str) -> bool:
    """Return True for the standard library's wrapper of that name, which is slow to import."""
    module = sys.modules.get("xmlrpc.client")
    return module is not None and isinstance(value, getattr(module, name))
