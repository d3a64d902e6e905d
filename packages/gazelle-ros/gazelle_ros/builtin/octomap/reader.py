"""Files of OctoMap: ``.bt``, which cells are occupied and which free, and ``.ot``, with likelihoods."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gazelle_ros.base.array_types import Ints64
from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin.octomap.codec import FREE, INNER
from gazelle_ros.builtin.octomap.morton import DEPTH

_MOST_CELLS = 50_000_000
_NODE = struct.Struct("<fB")
_WORD = struct.Struct("<H")
_KIND = "OcTree"

Leaf = tuple[int, int, float]
"""Code and depth of a leaf, and its log odds; inf and -inf where the file has no likelihoods."""


@dataclass(frozen=True, slots=True)
class OctomapFile:
    """Contents of a file.

    Attributes:
        resolution: Side of a cell [m].
        codes: Of the cells, ascending.
        values: Log odds of being occupied, shape (n,); inf and -inf in ``.bt`` files.
    """

    resolution: float
    codes: Ints64
    values: NDArray[np.float32]


def read_octomap(path: Path) -> OctomapFile:
    """Read a map; leaves of the tree that are larger than a cell become all their cells.

    Raises:
        RosError: There is no such file, it is no map of occupied and free cells, or is damaged.
    """
    try:
        whole = path.read_bytes()
    except OSError as error:
        raise RosError(f"the map cannot be read: {error.strerror}", file=str(path)) from error
    head, found, data = whole.partition(b"\ndata\n")
    lines = head.decode(errors="replace").splitlines()
    if not found or not lines[0].startswith("# Octomap OcTree"):
        raise RosError("this is not a file of OctoMap's OcTree", file=str(path))
    fields = dict(line.split(maxsplit=1) for line in lines[1:] if len(line.split()) > 1)
    resolution = _number(fields.get("res", ""))
    if fields.get("id") != _KIND or not 0.0 < resolution < np.inf:
        hint = f"a head has 'id {_KIND}' and 'res METRES'"
        raise RosError("the head of the map is wrong", file=str(path), hint=hint)
    leaves = _binary_leaves(data) if lines[0].endswith(" binary file") else _full_leaves(data)
    try:
        codes, values = _cells(list(leaves))
    except struct.error:
        raise RosError("the map ends in the middle of its tree", file=str(path)) from None
    except ValueError as error:
        raise RosError(str(error), file=str(path)) from None
    return OctomapFile(resolution, codes, values)


def _number(text: str) -> float:
    """Return a number, or nan."""
    try:
        return float(text)
    except ValueError:
        return np.nan


def _binary_leaves(data: bytes) -> Iterator[Leaf]:
    """Yield the leaves of a tree of two bytes for each inner node."""
    waiting, place = [(0, 0)] if data else [], 0
    while waiting:
        code, depth = waiting.pop()
        if depth == DEPTH:
            raise ValueError(f"the map has inner nodes at depth {DEPTH}")
        (word,) = _WORD.unpack_from(data, place)
        place += _WORD.size
        inner = []
        for child in range(8):
            kind = word >> 2 * child & 3
            if kind == INNER:
                inner.append((code << 3 | child, depth + 1))
            elif kind:
                yield code << 3 | child, depth + 1, -np.inf if kind == FREE else np.inf
        waiting += reversed(inner)


def _full_leaves(data: bytes) -> Iterator[Leaf]:
    """Yield the leaves of a tree with the likelihood and the children of each node."""
    waiting, place = [(0, 0)] if data else [], 0
    while waiting:
        code, depth = waiting.pop()
        value, children = _NODE.unpack_from(data, place)
        place += _NODE.size
        if not children:
            yield code, depth, value
        elif depth == DEPTH:
            raise ValueError(f"the map has inner nodes at depth {DEPTH}")
        waiting += [(code << 3 | i, depth + 1) for i in range(7, -1, -1) if children >> i & 1]


def _cells(leaves: list[Leaf]) -> tuple[Ints64, NDArray[np.float32]]:
    """Return all cells of leaves, ascending, and their log odds."""
    leaves = sorted(leaves, key=lambda leaf: leaf[0] << 3 * (DEPTH - leaf[1]))
    sizes = [8 ** (DEPTH - depth) for _, depth, _ in leaves]
    if sum(sizes) > _MOST_CELLS:
        raise ValueError(f"the map has {sum(sizes)} cells, and at most {_MOST_CELLS} are read")
    starts = np.array([code << 3 * (DEPTH - depth) for code, depth, _ in leaves], np.int64).reshape(
        -1
    )
    values = np.array([value for _, _, value in leaves], np.float32)
    if np.isnan(values).any():
        raise ValueError("the map has likelihoods that are not numbers")
    counts = np.array(sizes, np.int64)
    first = np.cumsum(counts) - counts
    within = np.arange(counts.sum()) - np.repeat(first, counts)
    return np.repeat(starts, counts) + within, np.repeat(values, counts)
