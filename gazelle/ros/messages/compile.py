"""Compile the methods of a message class when they are first called."""

from __future__ import annotations

import logging
import struct
import threading
from typing import Any

from gazelle.ros.messages import construct, decode, encode
from gazelle.ros.messages.arrays import shared_names
from gazelle.ros.messages.base import STRUCT_ERRORS, Message
from gazelle.ros.messages.emit import Code
from gazelle.ros.messages.errors import DeserializationError
from gazelle.ros.time import Duration, Time

_lock = threading.RLock()
_shared = shared_names() | {
    "_new": object.__new__,
    "_Time": Time,
    "_Duration": Duration,
    "_struct_errors": STRUCT_ERRORS,
}


def compiled(owner: type[Message], method: str) -> Any:
    """The method of a generated class, compiled now if it is not yet, and set on the class."""
    with _lock:
        made = owner.__dict__.get(method)
        if made is None:
            made = _make(owner, method)
            setattr(owner, method, made)
    return made


def _make(owner: type[Message], method: str) -> Any:
    spec, known = owner._spec, owner._known  # type: ignore[attr-defined]  # noqa: SLF001  # set by generate
    if method == "deserialize":
        return _make_deserialize(owner)
    if method == "deserialize_numpy":
        return _make_deserialize_numpy(owner)
    names = dict(_shared) | {"_slots": owner.__slots__}
    code = Code(names)
    kind, _, mode = method.rpartition("_")
    if method == "__init__":
        text = construct.write_constructor(spec, code, known)
    elif method == "serialize":
        text = encode.write_encoder(spec, code, known)
    elif method == "_write":
        text = encode.write_element_encoder(spec, code, known)
    elif kind == "_decode":
        text = decode.write_decoder(spec, code, known, mode)
    else:
        text = decode.write_element_decoder(spec, code, known, mode)
    exec(compile(text, f"<{owner._type} {method}>", "exec"), names)  # noqa: S102, SLF001  # names are checked by the parser
    return names[method]


def _make_deserialize(owner: type[Message]) -> Any:
    plain = compiled(owner, "_decode_plain")

    def deserialize(self: Message, data: bytes, numpy: bool = False) -> Message:  # noqa: FBT001, FBT002
        try:
            if numpy:
                return _decode(owner, "arrays", self, data)
            if type(data) is not bytes:
                data = bytes(data)
            return plain(self, data)  # type: ignore[no-any-return]
        except UnicodeDecodeError:
            _warn_once(owner)
            return _decode(owner, "lossy", self, data)
        except struct.error as err:
            raise DeserializationError(str(err)) from err

    return deserialize


def _make_deserialize_numpy(owner: type[Message]) -> Any:
    def deserialize_numpy(self: Message, data: bytes, numpy: object) -> Message:
        del numpy
        try:
            return _decode(owner, "numpy", self, data)
        except struct.error as err:
            raise DeserializationError(str(err)) from err

    return deserialize_numpy


def _decode(owner: type[Message], mode: str, message: Message, data: bytes) -> Message:
    made: Message = compiled(owner, f"_decode_{mode}")(message, data)
    return made


def _warn_once(owner: type[Message]) -> None:
    name = owner._type  # noqa: SLF001  # our own class
    if name not in _warned:
        _warned.add(name)
        logging.getLogger("rosout").error(
            "Characters replaced when decoding message %s (will print only once)", name
        )


_warned: set[str] = set()
