"""Message classes with numpy arrays for numeric arrays."""

from __future__ import annotations

import functools
from typing import Any

import numpy as np


@functools.cache
def numpy_msg(msg_type: Any) -> Any:
    """Return the class of messages of a type, with numpy arrays in place of lists and tuples."""

    def deserialize(self: Any, data: bytes) -> Any:
        return self.deserialize_numpy(data, np)

    body = {
        "__slots__": (),
        "__doc__": msg_type.__doc__,
        "deserialize": deserialize,
    }
    # A message lists its own fields in __slots__; the subclass adds none.
    made = type(f"Numpy_{msg_type._type.replace('/', '__')}", (msg_type,), body)
    made.__slots__ = msg_type.__slots__  # type: ignore[attr-defined]
    return made
