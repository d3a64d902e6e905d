"""STL files, binary and text."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import FormatError

_HEADER = 84
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])

Triangles = tuple[NDArray[np.float64], NDArray[np.int32]]


def parse(data: bytes) -> Triangles:
    """Vertices, shape (n, 3), and faces, shape (m, 3), of an STL file.

    Whether a file is binary is told by its length: many binary ones begin with the word
    ``solid``, which is meant to mark text. Corners at the same place become one vertex.

    Raises:
        FormatError: The file is neither.
    """
    count = int.from_bytes(data[80:_HEADER], "little") if len(data) >= _HEADER else 0
    room = (len(data) - _HEADER) // _TRIANGLE.itemsize
    text = data[:512].lstrip().lower().startswith(b"solid")
    if count > 0 and (count == room or (not text and count <= room)):
        return _weld(_binary(data, count))
    if text and b"facet" in data[:4096]:
        return _weld(_text(data))
    if room > 0 and not text:
        return _weld(_binary(data, room))  # cut short: what is there is used
    raise FormatError("this is no STL file")


def _binary(data: bytes, count: int) -> NDArray[np.float64]:
    triangles = np.frombuffer(data, _TRIANGLE, count=count, offset=_HEADER)
    return triangles["corners"].reshape(-1, 3).astype(np.float64)


def _text(data: bytes) -> NDArray[np.float64]:
    words = data.lower().split()
    numbers: list[bytes] = []
    for at, word in enumerate(words):
        if word == b"vertex":
            numbers.extend(words[at + 1 : at + 4])
    try:
        corners = np.array(numbers, dtype=np.float64).reshape(-1, 3)
    except ValueError as error:
        raise FormatError(f"a vertex of the STL file is wrong: {error}") from None
    if len(corners) % 3:
        raise FormatError("a facet of the STL file has not three vertices")
    return corners


def _weld(corners: NDArray[np.float64]) -> Triangles:
    """Same corners as one vertex, in the order of their first use."""
    if not len(corners):
        return corners, np.empty((0, 3), np.int32)
    corners = corners + 0.0  # -0.0 is 0.0
    keys = np.ascontiguousarray(corners).view(np.dtype((np.void, 24))).ravel()
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    order = np.argsort(first, kind="stable")
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return corners[first[order]], rank[inverse].reshape(-1, 3).astype(np.int32)
