"""Compile the methods of a message class when they are first called."""

from __future__ import annotations

import logging
import struct
import threading
from typing import Any

from gazelle_ros.messages import construct, decode, encode
from gazelle_ros.messages.arrays import shared_names
from gazelle_ros.messages.base import STRUCT_ERRORS, Message
from gazelle_ros.messages.emit import GeneratedCode
from gazelle_ros.messages.errors import DeserializationError
from gazelle_ros.time import Duration, Time

_lock = threading.RLock()
_warned: set[str] = set()


def compiled(owner: type[Message], method: str) -> Any:
    """Return the method of a generated class, compiled on first use and set on the class."""
    with _lock:
        made = owner.__dict__.get(method)
        if made is None:
            made = _make(owner, method)
            setattr(owner, method, made)
    return made


def warn_once(name: str) -> None:
    """Log that a message had text that is not UTF-8, once for each type."""
    if name not in _warned:
        _warned.add(name)
        logging.getLogger("rosout").error(
            "Characters replaced when decoding message %s (will print only once)", name
        )


_shared = shared_names() | {
    "_new": object.__new__,
    "_Time": Time,
    "_Duration": Duration,
    "_struct_errors": STRUCT_ERRORS,
    "_struct_error": struct.error,
    "_DeserializationError": DeserializationError,
    "_warn_once": warn_once,
}


def _make(owner: type[Message], method: str) -> Any:
    names = dict(_shared) | {"_slots": owner.__slots__}
    text = _source(owner, method, GeneratedCode(names))
    exec(compile(text, f"<{owner._type} {method}>", "exec"), names)  # noqa: S102  # names are checked by the parser
    return names[method]


def _source(owner: type[Message], method: str, code: GeneratedCode) -> str:
    spec, known = owner._spec, owner._known  # type: ignore[attr-defined]  # set by generate
    if method in _WRITERS:
        return _WRITERS[method](spec, code, known)
    kind, _, mode = method.rpartition("_")
    write = decode.write_decoder if kind == "_decode" else decode.write_element_decoder
    return write(spec, code, known, mode)


_WRITERS = {
    "__init__": construct.write_constructor,
    "serialize": encode.write_encoder,
    "_write": encode.write_element_encoder,
    "deserialize": decode.write_deserialize,
}
