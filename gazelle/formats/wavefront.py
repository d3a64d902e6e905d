"""Wavefront OBJ files: positions and faces; materials are in `wavefront_materials`.

Not by trimesh: ``docs/explanation/decisions/009-own-stl-and-obj.md``.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import FormatError

Piece = tuple[str, NDArray[np.float64], NDArray[np.int32]]


def parse(data: bytes) -> list[Piece]:
    """Parse name, vertices (n, 3) and faces (m, 3) of each object; polygons become fans.

    Negative indices count back from the last vertex above their line, as the format has it;
    positive ones may name a vertex below.

    Raises:
        FormatError: A line is wrong; it is named.
    """
    vertices: list[tuple[float, float, float]] = []
    groups: dict[str, list[tuple[int, int, int]]] = {}
    faces = groups.setdefault("", [])
    for number, line in numbered_lines(data):
        words = line.split()
        if not words:
            continue
        try:
            if words[0] == "v":
                vertices.append((float(words[1]), float(words[2]), float(words[3])))
            elif words[0] == "f":
                corners = _corners(line, words, len(vertices))
                faces += [(corners[0], b, c) for b, c in itertools.pairwise(corners[1:])]
            elif words[0] in {"o", "g"}:
                faces = groups.setdefault(" ".join(words[1:]), [])
        except (ValueError, IndexError):
            raise _wrong(number, line) from None
    positions = np.array(vertices, np.float64).reshape(-1, 3)
    pieces = [(name, np.array(found)) for name, found in groups.items() if found]
    if any(found.max() > len(positions) for _, found in pieces):
        raise _beyond(data, len(positions))
    return [(name, *used_only(positions, found - 1)) for name, found in pieces]


def numbered_lines(data: bytes) -> Iterator[tuple[int, str]]:
    """Yield lines with their numbers; a backslash continues a line, but no comment."""
    lines = enumerate(data.decode("utf-8", errors="replace").splitlines(), start=1)
    if b"\\" not in data:
        yield from lines
        return
    start, begun = 1, ""
    for number, line in lines:
        if line.endswith("\\") and not (begun or line).lstrip().startswith("#"):
            begun += line[:-1] + " "
            continue
        yield start, begun + line
        start, begun = number + 1, ""
    yield start, begun


def _wrong(number: int, line: str, why: str = "") -> FormatError:
    return FormatError(
        f"line {number} of the OBJ file is wrong: '{line.strip()}'{why}",
        hint="fix the line, or export the file again",
    )


def _beyond(data: bytes, count: int) -> FormatError:
    """Return the error for the first face that names more than the ``count`` vertices."""
    number, line = next(
        (number, line)
        for number, line in numbered_lines(data)
        if (words := line.split())[:1] == ["f"]
        and max(_corners(line, words, count), default=0) > count
    )
    return _wrong(number, line, f"; the file has {count} vertices")


def _corners(line: str, words: list[str], count: int) -> list[int]:
    """Return indices from 1 of a face.

    Corners are ``7``, ``7/1``, ``7/1/2`` or ``-1``, the last of ``count``.
    """
    corners = [int(word.split("/", 1)[0]) for word in corner_words(line, words)]
    if corners and min(corners) < 1:
        if 0 in corners or -min(corners) > count:
            raise ValueError(line)
        return [corner if corner > 0 else count + 1 + corner for corner in corners]
    return corners


def corner_words(line: str, words: list[str]) -> list[str]:
    """Return the corners of a face as they are written; a comment may follow them."""
    return (line.partition("#")[0].split() if "#" in line else words)[1:]


def used_only(
    positions: NDArray[np.float64], faces: NDArray[np.integer[Any]]
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Return only the vertices that the faces name."""
    used, inverse = np.unique(faces, return_inverse=True)
    return positions[used], inverse.reshape(-1, 3).astype(np.int32)
