"""STL files, binary and text.

Not by trimesh: ``docs/explanation/decisions/009-own-stl-and-obj.md``.
"""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import FormatError

_HEADER = 84
_START = 4096
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
# The name of a solid, which may be any text, also "vertex"; not a whole file on one line.
_NAME = re.compile(rb"solid(?!.*\bfacet\b).*")
_VERTEX = re.compile(rb"vertex\s+(\S+)\s+(\S+)\s+(\S+)")
_AGAIN = "export or download the file again"

Triangles = tuple[NDArray[np.float64], NDArray[np.int32]]


def parse(data: bytes) -> Triangles:
    """Parse vertices, shape (n, 3), and faces, shape (m, 3), of an STL file.

    Whether a file is binary is decided by its length: many binary ones begin with the word
    ``solid``, which is meant to mark text. Corners at the same place become one vertex.

    Raises:
        FormatError: The file is neither, or was cut short.
    """
    count = int.from_bytes(data[80:_HEADER], "little") if len(data) >= _HEADER else 0
    room = max(0, (len(data) - _HEADER) // _TRIANGLE.itemsize)
    if _is_text(data) and not 0 < count == room:
        return _weld(_text(data))
    count = count or room  # some programs never fill it in
    if 0 < count <= room:
        return _weld(_binary(data, count))
    if len(data) <= _HEADER:
        raise FormatError("this is not an STL file", hint=_AGAIN)
    raise FormatError(
        f"this is not an STL file, or one that was cut short: its header says {count:,} triangles, "
        f"there are {room:,}",
        hint=_AGAIN,
    )


def _is_text(data: bytes) -> bool:
    start = data[:_START].lower()
    return start.lstrip().startswith(b"solid") and (b"facet" in start or b"endsolid" in start)


def _binary(data: bytes, count: int) -> NDArray[np.float64]:
    triangles = np.frombuffer(data, _TRIANGLE, count=count, offset=_HEADER)
    return triangles["corners"].reshape(-1, 3).astype(np.float64)


def _text(data: bytes) -> NDArray[np.float64]:
    data = _NAME.sub(b"solid", data.lower())
    vertices = _VERTEX.findall(data)
    try:
        corners = np.array(vertices, dtype=np.float64).reshape(-1, 3)
    except ValueError:
        wrong = next(word for vertex in vertices for word in vertex if not _is_number(word))
        text = (
            f"a vertex of the STL file is wrong: '{wrong.decode(errors='replace')}' is not a number"
        )
        raise FormatError(text, hint=_AGAIN) from None
    tail = data.rpartition(b"end")[2]  # "solid", "facet" or "loop"
    if len(corners) % 3 or (not tail.startswith(b"solid") and len(tail.split()) > 2):
        raise FormatError(
            "a facet of the STL file has not three vertices, or the file was cut short", hint=_AGAIN
        )
    return corners


def _weld(corners: NDArray[np.float64]) -> Triangles:
    """Merge equal corners into one vertex, in the order of their first use."""
    if not len(corners):
        return corners, np.empty((0, 3), np.int32)
    corners = corners + 0.0  # -0.0 is 0.0
    order = np.lexsort(corners.T)
    ordered = corners[order]
    begins = np.append(True, (ordered[1:] != ordered[:-1]).any(axis=1))
    vertices = np.sort(order[begins])
    uses = np.empty_like(order)
    uses[order] = np.searchsorted(vertices, order[begins])[np.cumsum(begins) - 1]
    return corners[vertices], uses.reshape(-1, 3).astype(np.int32)


def _is_number(word: bytes) -> bool:
    try:
        np.array([word], dtype=np.float64)
    except ValueError:
        return False
    return True
