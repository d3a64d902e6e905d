"""Materials and pictures of OBJ files, for rendering: MTL files beside the OBJ file.

Shapes alone do not need them (`wavefront`).
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Protocol

import numpy as np

from gazelle.array_types import Floats, Ints32, Ints64
from gazelle.formats.mesh_materials import PLAIN, MeshMaterial
from gazelle.formats.wavefront import corner_words, numbered_lines, used_only

MAX_BYTES = 4 * 2**20


class WavefrontPiece(Protocol):
    """A piece of an OBJ file as `wavefront` reads it."""

    @property
    def name(self) -> str:
        """Name of the object."""

    @property
    def vertices(self) -> Floats:
        """Positions."""

    @property
    def faces(self) -> Ints32:
        """Corners of triangles, in the order of the file."""


@dataclass(slots=True)
class _Painted:
    """Materials and texture coordinates of the triangles of one object."""

    materials: list[str] = field(default_factory=list)
    places: list[tuple[int, int, int]] = field(default_factory=list)


def painted(
    path: Path, pieces: Sequence[WavefrontPiece]
) -> Iterator[tuple[str, Floats, Ints32, MeshMaterial]]:
    """Yield the pieces of an OBJ file by their materials.

    Yields:
        Name, vertices (n, 3), triangles of one material (m, 3), and that material.
    """
    objects, uv, libraries = _read(path)
    materials: dict[str, MeshMaterial] = {}
    for library in libraries:
        materials = _library(path, library) | materials
    for piece in pieces:
        assigned = objects.get(piece.name)
        if assigned is None or len(assigned.materials) != len(piece.faces):
            yield piece.name, piece.vertices, piece.faces, PLAIN
            continue
        names, which = np.unique(assigned.materials, return_inverse=True)
        corners = np.array(assigned.places, np.int64).reshape(-1, 3)
        for number, name in enumerate(names.tolist()):
            chosen = which.ravel() == number
            material = materials.get(name, PLAIN)
            material = replace(material, uv=_uv(corners[chosen], uv))
            yield piece.name, *used_only(piece.vertices, piece.faces[chosen]), material


def _uv(corners: Ints64, uv: Floats) -> Floats | None:
    """Return places in a picture, shape (m, 3, 2); None where a corner has none."""
    if not len(corners) or corners.min() < 1 or corners.max() > len(uv):
        return None
    placed: Floats = uv[corners - 1]
    return placed


def _read(path: Path) -> tuple[dict[str, _Painted], Floats, list[str]]:
    """Read materials of each object's triangles, places in pictures, and material libraries."""
    objects: dict[str, _Painted] = {}
    uv: list[tuple[float, float]] = []
    libraries: list[str] = []
    material = ""
    current = objects.setdefault("", _Painted())
    for _, line in numbered_lines(path.read_bytes()):
        words = line.split()
        kind = words[0] if words else ""
        if kind == "vt":
            numbers = [float(word) for word in words[1:3]]
            uv.append((numbers[0], numbers[1] if len(numbers) > 1 else 0.0))
        elif kind == "f":
            corners = [_place(word, len(uv)) for word in corner_words(line, words)]
            for b, c in itertools.pairwise(corners[1:]):
                current.places.append((corners[0], b, c))
                current.materials.append(material)
        elif kind in {"o", "g"}:
            current = objects.setdefault(" ".join(words[1:]), _Painted())
        elif kind == "usemtl":
            material = " ".join(line.partition(" #")[0].split()[1:])
        elif kind == "mtllib":
            libraries.append(line.split(maxsplit=1)[1].strip() if len(words) > 1 else "")
    return objects, np.array(uv, np.float64).reshape(-1, 2), libraries


def _place(word: str, count: int) -> int:
    """Return the number of a corner's place in a picture, from 1; 0 for none."""
    parts = word.split("/")
    if len(parts) < 2 or not parts[1]:
        return 0
    number = int(parts[1])
    return number if number > 0 else count + 1 + number


def _library(mesh: Path, name: str) -> dict[str, MeshMaterial]:
    """Return the materials of an MTL file beside the OBJ file; none if it is not there."""
    here = mesh.resolve().parent
    plain = name.replace("\\", "/")
    for candidate in (here / plain, here / plain.rpartition("/")[2]):
        found = candidate.resolve()
        if found.is_file() and found.is_relative_to(here.parent):
            break
    else:
        return {}
    if found.stat().st_size > MAX_BYTES:
        return {}
    return parse_library(found.read_text("utf-8", errors="replace"))


def parse_library(text: str) -> dict[str, MeshMaterial]:
    """Parse the materials of an MTL file by name; unknown parts are skipped."""
    materials: dict[str, MeshMaterial] = {}
    name: str | None = None
    for line in text.splitlines():
        words = line.partition("#")[0].split()
        if not words:
            continue
        if words[0] == "newmtl":
            name = " ".join(words[1:])
            materials[name] = PLAIN
        elif name is not None:
            materials[name] = _refined(materials[name], words)
    return materials


def _refined(material: MeshMaterial, words: list[str]) -> MeshMaterial:
    try:
        if words[0] == "Kd":
            red, green, blue = (min(1.0, max(0.0, float(word))) for word in words[1:4])
            return replace(material, color=(red, green, blue))
        if words[0] == "d":
            return replace(material, alpha=min(1.0, max(0.0, float(words[-1]))))
        if words[0] == "Tr":
            return replace(material, alpha=1.0 - min(1.0, max(0.0, float(words[1]))))
    except (ValueError, IndexError):
        return material
    if words[0] == "map_Kd" and len(words) > 1:
        return replace(material, texture=_file_of(words[1:]))
    return material


def _file_of(words: list[str]) -> str:
    """Return the file's name after the options of a map, such as ``-s 1 1 1``.

    It may hold spaces.
    """
    rest = list(words)
    while rest and rest[0].startswith("-") and len(rest) > 1:
        rest.pop(0)
        while len(rest) > 1 and _is_value(rest[0]):
            rest.pop(0)
    return " ".join(rest)


def _is_value(word: str) -> bool:
    if word in {"on", "off"}:
        return True
    try:
        float(word)
    except ValueError:
        return False
    return True
