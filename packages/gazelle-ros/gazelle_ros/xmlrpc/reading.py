"""XML-RPC documents to values: strict, with limits, no entities, no document types."""

from __future__ import annotations

import base64
import binascii
from typing import Any
from xml.parsers import expat

from gazelle_ros.errors import FaultError, MarshalError
from gazelle_ros.limits import LIMITS, NetworkLimits

_SCALARS = frozenset(
    {"i4", "int", "i8", "boolean", "double", "string", "dateTime.iso8601", "base64", "nil"}
)
_EXPECTED_IN: dict[str, frozenset[str]] = {
    "methodName": frozenset({"methodCall"}),
    "params": frozenset({"methodCall", "methodResponse"}),
    "fault": frozenset({"methodResponse"}),
    "param": frozenset({"params"}),
    "value": frozenset({"param", "data", "member", "fault"}),
    "array": frozenset({"value"}),
    "struct": frozenset({"value"}),
    "data": frozenset({"array"}),
    "member": frozenset({"struct"}),
    "name": frozenset({"member"}),
}
_MISSING = object()
_PIECE_BYTES = 64 * 1024


def read_call(document: bytes, limits: NetworkLimits = LIMITS) -> tuple[str, list[Any]]:
    """Read the method's name and the parameters of a call.

    Raises:
        MarshalError: It is not an XML-RPC call, or exceeds a limit.
    """
    reader = _read(document, "methodCall", limits)
    if reader.method is None:
        raise MarshalError("the call has no methodName")
    return reader.method, reader.params


def read_response(document: bytes, limits: NetworkLimits = LIMITS) -> Any:
    """Read the value of an answer.

    Raises:
        FaultError: It is a fault.
        MarshalError: It is not XML-RPC answer, or exceeds a limit.
    """
    reader = _read(document, "methodResponse", limits)
    if reader.fault is not _MISSING:
        fault = reader.fault
        if not isinstance(fault, dict):
            raise MarshalError("the fault is not a struct")
        code = fault.get("faultCode")
        raise FaultError(
            code if isinstance(code, int) else 0, str(fault.get("faultString", "unknown"))
        )
    if len(reader.params) != 1:
        raise MarshalError(f"the answer holds {len(reader.params)} values instead of one")
    return reader.params[0]


def _read(document: bytes, root: str, limits: NetworkLimits) -> _Reader:
    reader = _Reader(root, limits)
    try:
        # Piece by piece: meanwhile no other thread runs.
        with memoryview(document) as view:
            for begin in range(0, len(document), _PIECE_BYTES):
                reader.parser.Parse(view[begin : begin + _PIECE_BYTES])
        reader.parser.Parse(b"", True)
    except expat.ExpatError as error:
        raise MarshalError(f"not well-formed XML: {error}") from None
    except MarshalError:
        raise
    except (RecursionError, ValueError, LookupError) as error:  # an encoding that expat refuses
        raise MarshalError(f"not an XML-RPC document: {error}") from None
    return reader


class _Value:
    """A value being read: a container's items, or a scalar's kind."""

    __slots__ = ("items", "kind", "name", "result")

    def __init__(self) -> None:
        self.kind: str | None = None
        self.items: Any = None
        self.name: str | None = None
        self.result: Any = _MISSING


class _Reader:
    """Collects what the XML parser sees."""

    def __init__(self, root: str, limits: NetworkLimits) -> None:
        self.root = root
        self.limits = limits
        self.method: str | None = None
        self.params: list[Any] = []
        self.fault: Any = _MISSING
        self._path: list[str] = []
        self._values: list[_Value] = []
        self._text: list[str] = []
        self._count = 0
        self.parser = expat.ParserCreate()
        self.parser.buffer_text = True
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._text.append
        self.parser.StartDoctypeDeclHandler = self._refuse_doctype

    def _refuse_doctype(self, *_: Any) -> None:
        raise MarshalError("document types are refused")

    def _start(self, tag: str, _attributes: dict[str, str]) -> None:
        path = self._path
        parent = path[-1] if path else ""
        if not path:
            if tag != self.root:
                raise MarshalError(f"expected <{self.root}>, found <{tag}>")
        elif tag in _SCALARS:
            self._begin_scalar(tag, parent)
        elif parent not in _EXPECTED_IN.get(tag, ()):
            raise MarshalError(f"<{tag}> is out of place in <{parent}>")
        elif tag == "value":
            self._begin_value()
        elif tag in {"array", "struct"}:
            self._begin_container(tag)
        elif tag == "member":
            self._values[-1].name = None
        path.append(tag)
        self._text.clear()

    def _begin_value(self) -> None:
        self._count += 1
        if self._count > self.limits.xml_values:
            raise MarshalError(f"more than {self.limits.xml_values} values")
        if len(self._values) >= self.limits.xml_depth:
            raise MarshalError(f"nested deeper than {self.limits.xml_depth}")
        self._values.append(_Value())

    def _begin_container(self, tag: str) -> None:
        value = self._values[-1]
        if value.kind is not None:
            raise MarshalError("a value with two types")
        value.kind = tag
        value.items = [] if tag == "array" else {}

    def _begin_scalar(self, tag: str, parent: str) -> None:
        if parent != "value" or self._values[-1].kind is not None:
            raise MarshalError(f"<{tag}> is out of place in <{parent}>")
        self._values[-1].kind = tag

    def _end(self, tag: str) -> None:
        self._path.pop()
        if tag == "value":
            self._end_value()
        elif tag in _SCALARS:
            self._values[-1].result = _scalar(tag, "".join(self._text))
        elif tag in {"array", "struct"}:
            self._values[-1].result = self._values[-1].items
        elif tag == "name":
            self._values[-1].name = "".join(self._text)
        elif tag == "methodName":
            self.method = "".join(self._text).strip()
        self._text.clear()

    def _end_value(self) -> None:
        value = self._values.pop()
        if value.kind is None:
            value.result = "".join(self._text)
        parent = self._path[-1]
        if parent == "param":
            self.params.append(value.result)
        elif parent == "fault":
            self.fault = value.result
        else:
            holder = self._values[-1]
            if parent == "data":
                holder.items.append(value.result)
            elif holder.name is None:
                raise MarshalError("a struct's value has no name before it")
            else:
                holder.items[holder.name] = value.result


def _scalar(tag: str, text: str) -> Any:
    if tag == "string":
        return text
    if tag == "nil":
        return None
    try:
        if tag == "boolean":
            return _BOOLEANS[text.strip()]
        if tag == "double":
            return float(text)
        if tag == "base64":
            return _binary(base64.b64decode(text))
        if tag == "dateTime.iso8601":
            return _date(text.strip())
        return int(text)
    except (ValueError, KeyError, binascii.Error):
        raise MarshalError(f"<{tag}> holds {text[:40]!r}") from None


_BOOLEANS = {"0": False, "1": True, "false": False, "true": True}


def _binary(data: bytes) -> Any:
    """Return the standard library's wrapper, as ROS programs expect; its import is slow."""
    from xmlrpc.client import Binary

    return Binary(data)


def _date(text: str) -> Any:
    from xmlrpc.client import DateTime

    return DateTime(text)
