"""The names of six that scripts for Python 2 and 3 use, for where six is not installed."""

from __future__ import annotations

import builtins
import sys
import types
from collections.abc import Callable, Iterator, Mapping
from functools import wraps
from io import BytesIO, StringIO
from typing import Any, NoReturn

__all__ = [
    "PY2",
    "PY3",
    "PY34",
    "BytesIO",
    "StringIO",
    "add_metaclass",
    "advance_iterator",
    "b",
    "binary_type",
    "byte2int",
    "callable",
    "class_types",
    "ensure_binary",
    "ensure_str",
    "ensure_text",
    "get_function_code",
    "get_method_function",
    "get_method_self",
    "indexbytes",
    "int2byte",
    "integer_types",
    "iterbytes",
    "iteritems",
    "iterkeys",
    "iterlists",
    "itervalues",
    "next",
    "print_",
    "python_2_unicode_compatible",
    "raise_from",
    "reraise",
    "string_types",
    "text_type",
    "u",
    "unichr",
    "viewitems",
    "viewkeys",
    "viewvalues",
    "with_metaclass",
    "wraps",
]

PY2, PY3, PY34 = False, True, True
string_types = (str,)
integer_types = (int,)
class_types = (type,)
text_type = str
binary_type = bytes
MAXSIZE = sys.maxsize
unichr = chr
print_ = builtins.print
next = advance_iterator = builtins.next  # noqa: A001  # six calls it so
callable = builtins.callable  # noqa: A001  # likewise
iterbytes = iter


def iterkeys(mapping: Mapping[Any, Any], **options: Any) -> Iterator[Any]:
    """Return an iterator over the keys."""
    return iter(mapping.keys(**options))


def itervalues(mapping: Mapping[Any, Any], **options: Any) -> Iterator[Any]:
    """Return an iterator over the values."""
    return iter(mapping.values(**options))


def iteritems(mapping: Mapping[Any, Any], **options: Any) -> Iterator[tuple[Any, Any]]:
    """Return an iterator over the pairs."""
    return iter(mapping.items(**options))


def iterlists(mapping: Any, **options: Any) -> Iterator[tuple[Any, Any]]:
    """Return an iterator over the pairs of a mapping of several values."""
    return iter(mapping.lists(**options))


def viewkeys(mapping: Mapping[Any, Any]) -> Any:
    """Return the view of the keys."""
    return mapping.keys()


def viewvalues(mapping: Mapping[Any, Any]) -> Any:
    """Return the view of the values."""
    return mapping.values()


def viewitems(mapping: Mapping[Any, Any]) -> Any:
    """Return the view of the pairs."""
    return mapping.items()


def b(text: str) -> bytes:
    """Return a text as bytes."""
    return text.encode("latin-1")


def u(text: str) -> str:
    """Return a text."""
    return text


def byte2int(data: bytes) -> int:
    """Return the first byte."""
    return data[0]


def int2byte(number: int) -> bytes:
    """Return a number as one byte."""
    return bytes((number,))


def indexbytes(data: bytes, index: int) -> int:
    """Return a byte."""
    return data[index]


def ensure_binary(text: str | bytes, encoding: str = "utf-8", errors: str = "strict") -> bytes:
    """Return a text as bytes."""
    return text.encode(encoding, errors) if isinstance(text, str) else text


def ensure_text(text: str | bytes, encoding: str = "utf-8", errors: str = "strict") -> str:
    """Return bytes as text."""
    return text if isinstance(text, str) else text.decode(encoding, errors)


ensure_str = ensure_text


def reraise(kind: Any, value: Any, trace: types.TracebackType | None = None) -> NoReturn:
    """Raise an exception with the traceback that it had."""
    raise (kind() if value is None else value).with_traceback(trace)


def raise_from(value: BaseException, cause: BaseException | None) -> NoReturn:
    """Raise an exception because of another."""
    raise value from cause


def exec_(code: Any, names: dict[str, Any] | None = None, own: Any = None) -> None:
    """Execute code in the namespace of the caller, or in another."""
    frame = sys._getframe(1)  # noqa: SLF001  # as six does
    builtins.exec(code, frame.f_globals if names is None else names, own)  # noqa: S102  # what it is for


def with_metaclass(meta: type, *bases: type) -> Any:
    """Return a base that makes classes of a metaclass."""

    class Maker(type):
        def __new__(cls, name: str, _: Any, body: dict[str, Any]) -> Any:
            return meta(name, bases, body)

    return type.__new__(Maker, "temporary_class", (), {})


def add_metaclass(meta: type) -> Callable[[type], Any]:
    """Return a decorator that makes a class again with a metaclass."""

    def remake(cls: type) -> Any:
        body = {k: v for k, v in vars(cls).items() if k not in {"__dict__", "__weakref__"}}
        return meta(cls.__name__, cls.__bases__, body)

    return remake


def python_2_unicode_compatible(cls: type) -> type:
    """Return a class as it is."""
    return cls


def get_function_code(function: Any) -> types.CodeType:
    """Return the code of a function."""
    code: types.CodeType = function.__code__
    return code


def get_method_function(method: Any) -> Any:
    """Return the function of a method."""
    return method.__func__


def get_method_self(method: Any) -> Any:
    """Return what a method is bound to."""
    return method.__self__
