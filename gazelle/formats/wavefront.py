"""Wavefront OBJ files: positions and faces; materials do not matter here."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import FormatError

Piece = tuple[str, NDArray[np.float64], NDArray[np.int32]]


def parse(data: bytes) -> list[Piece]:
    """Name, vertices (n, 3) and faces (m, 3) of each object; polygons become fans.

    Raises:
        FormatError: A line is wrong; it is named.
    """
    vertices: list[tuple[float, float, float]] = []
    groups: dict[str, list[tuple[int, int, int]]] = {}
    faces = groups.setdefault("", [])
    text = data.decode("utf-8", errors="replace").replace("\\\n", " ")
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.split()
        if not words:
            continue
        try:
            if words[0] == "v":
                vertices.append((float(words[1]), float(words[2]), float(words[3])))
            elif words[0] == "f":
                corners = [_corner(word, len(vertices)) for word in words[1:]]
                faces.extend((corners[0], b, c) for b, c in itertools.pairwise(corners[1:]))
            elif words[0] in {"o", "g"}:
                faces = groups.setdefault(" ".join(words[1:]), [])
        except (ValueError, IndexError):
            raise FormatError(f"line {number} of the OBJ file is wrong: '{line.strip()}'") from None
    positions = np.array(vertices, np.float64).reshape(-1, 3)
    return [
        (name, *_used(positions, np.array(found, np.int32)))
        for name, found in groups.items()
        if found
    ]


def _corner(word: str, count: int) -> int:
    """Index from 0 of ``7``, ``7/1``, ``7/1/2`` or ``-1``, which counts from the end."""
    index = int(word.split("/", maxsplit=1)[0])
    corner = index - 1 if index > 0 else count + index
    if not 0 <= corner < count:
        raise ValueError(word)
    return corner


def _used(
    positions: NDArray[np.float64], faces: NDArray[np.int32]
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Only the vertices that the faces name."""
    used, inverse = np.unique(faces, return_inverse=True)
    return positions[used], inverse.reshape(-1, 3).astype(np.int32)
