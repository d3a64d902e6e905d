"""Mesh files as vertices and faces: STL, DAE, OBJ and what else trimesh reads.

The result is in the frame of the description's ``<mesh>``: the file's unit, up-axis and
node transforms are applied, then the scale. Files are read once: the last ones stay in
memory, found by their content.
"""

from __future__ import annotations

import hashlib
import logging
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.description import Mesh, Source, Vector3
from gazelle.errors import FormatError
from gazelle.formats import collada, stl, wavefront, wavefront_materials
from gazelle.formats.lfs import refuse_pointer
from gazelle.formats.limits import read_bounded
from gazelle.formats.mesh_materials import PLAIN, MeshMaterial, material_of_trimesh
from gazelle.geometry.mesh_data import MeshData

CACHED = 256

_AGAIN = "export or download the file again"


@dataclass(frozen=True, slots=True)
class MeshPart:
    """A named piece of a mesh file.

    Attributes:
        name: Of the node or object in the file; may be empty.
        vertices: Positions [m], shape (n, 3).
        faces: Corners of each triangle, shape (m, 3).
        material: Colours from the file.
    """

    name: str
    vertices: NDArray[np.float64]
    faces: NDArray[np.int32]
    material: MeshMaterial = PLAIN


@checked(FormatError, after=True)
def load_mesh(mesh: Mesh) -> MeshData:
    """Load the triangles of a description's mesh, scaled.

    Raises:
        FormatError: The file was not found, cannot be read, or holds no triangle or not
            the requested submesh. It names the place in the description.
    """
    return _placed(_joined(_parts_of(mesh)), mesh)


@checked(FormatError, after=True)
def load_mesh_parts(mesh: Mesh) -> tuple[MeshPart, ...]:
    """Load the pieces of a description's mesh, scaled, with their looks.

    Raises:
        FormatError: As ``load_mesh``.
    """
    parts = _parts_of(mesh)
    if mesh.path is not None and mesh.path.suffix.lower() == ".obj":
        parts = [MeshPart(*piece) for piece in wavefront_materials.painted(mesh.path, parts)]
    vertices = _placed(_joined(parts), mesh).vertices
    turned = slice(None, None, -1) if np.prod(mesh.scale) < 0.0 else slice(None)
    placed, begin = [], 0
    for part in parts:
        end = begin + len(part.vertices)
        uv = None if part.material.uv is None else part.material.uv[:, turned]
        material = replace(part.material, uv=uv)
        placed.append(MeshPart(part.name, vertices[begin:end], part.faces[:, turned], material))
        begin = end
    return tuple(placed)


def _parts_of(mesh: Mesh) -> list[MeshPart]:
    if mesh.path is None:
        raise FormatError(f"the mesh '{mesh.uri}' was not found", source=mesh.source)
    try:
        parts = load_parts(mesh.path)
    except FormatError as error:
        raise FormatError(
            f"the mesh '{mesh.path}' cannot be used: {error.message}",
            source=mesh.source or Source(str(mesh.path)),
            hint=error.hint,
        ) from error
    return _chosen(parts, mesh)


def _placed(data: MeshData, mesh: Mesh) -> MeshData:
    vertices = data.vertices * np.asarray(mesh.scale, dtype=np.float64)
    if mesh.center_submesh:
        vertices = vertices - (vertices.min(axis=0) + vertices.max(axis=0)) / 2.0
    mirrored = np.prod(mesh.scale) < 0.0
    vertices.setflags(write=False)
    return MeshData(vertices, data.faces[:, ::-1] if mirrored else data.faces)


def bounds(mesh: Mesh) -> tuple[Vector3, Vector3]:
    """Return smallest and largest corner of a mesh [m], in its frame.

    Raises:
        FormatError: As ``load_mesh``.
    """
    low, high = load_mesh(mesh).bounds.tolist()
    return ((low[0], low[1], low[2]), (high[0], high[1], high[2]))


def load_parts(path: Path) -> tuple[MeshPart, ...]:
    """Load the pieces of a mesh file, unscaled, in the file's frame turned z up, in metres.

    Raises:
        FormatError: The file cannot be read, or holds no triangle.
    """
    try:
        data = read_bounded(path)
    except OSError as error:
        raise FormatError(f"the file cannot be read: {error}", file=str(path)) from error
    digest = hashlib.blake2b(data, digest_size=16).hexdigest()
    return _parse_cached(digest, _Content(data, path))


class _Content:
    """File content that the cache distinguishes by its digest alone."""

    def __init__(self, data: bytes, path: Path) -> None:
        self.data: bytes | None = data
        self.path = path

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Content) and self.path.suffix == other.path.suffix

    def __hash__(self) -> int:
        return hash(self.path.suffix)


@lru_cache(maxsize=CACHED)
def _parse_cached(_: str, content: _Content) -> tuple[MeshPart, ...]:
    data, path = content.data or b"", content.path
    content.data = None  # the cache keeps the key, and need not keep the file
    if not data:
        raise FormatError("the file is empty", file=str(path), hint=_AGAIN)
    refuse_pointer(data, path)
    try:
        parts = [part for part in _parse(data, path) if len(part.faces)]
    except FormatError:
        raise
    except (ImportError, MemoryError) as error:
        raise FormatError(f"{type(error).__name__}: {error}", file=str(path)) from error
    except Exception as error:  # mesh libraries raise anything on a broken file
        raise _damaged(path) from error
    if not parts:
        raise FormatError("the file holds no triangle", file=str(path))
    for part in parts:
        _check(part, path)
    return tuple(parts)


def _damaged(path: Path) -> FormatError:
    text = f"this is no {path.suffix.lower().lstrip('.').upper()} file, or a damaged one"
    if path.suffix.lower() == ".gltf":  # its buffers are often files of their own
        return FormatError(
            f"{text}, or it needs files beside it", file=str(path), hint="export it as .glb"
        )
    return FormatError(text, file=str(path), hint=_AGAIN)


def _check(part: MeshPart, path: Path) -> None:
    if not np.isfinite(part.vertices).all():
        raise FormatError("the file holds coordinates that are not finite", file=str(path))
    if part.faces.min() < 0 or part.faces.max() >= len(part.vertices):
        raise FormatError("a face names a vertex that is not there", file=str(path))
    part.vertices.setflags(write=False)
    part.faces.setflags(write=False)


def _parse(data: bytes, path: Path) -> list[MeshPart]:
    kind = path.suffix.lower().lstrip(".")
    if kind in {"stl", "stlb"}:
        return [MeshPart("", *stl.parse(data))]
    if kind == "dae":
        return [MeshPart(*piece) for piece in collada.parse(data)]
    if kind == "obj":
        return [MeshPart(*piece) for piece in wavefront.parse(data)]
    return _parse_with_trimesh(data, kind)


def _parse_with_trimesh(data: bytes, kind: str) -> list[MeshPart]:
    import io

    import trimesh

    logging.getLogger("trimesh").setLevel(logging.ERROR)
    if kind not in trimesh.available_formats():
        raise FormatError(
            f"mesh files of kind '.{kind}' cannot be read", hint="use STL, DAE or OBJ"
        )
    scene = trimesh.load_scene(io.BytesIO(data), file_type=kind, process=False)
    return [
        MeshPart(
            piece.metadata.get("name", ""),
            np.asarray(piece.vertices, np.float64),
            np.asarray(piece.faces, np.int32),
            material_of_trimesh(piece),
        )
        for piece in scene.dump()
        if hasattr(piece, "faces")
    ]


def _chosen(parts: tuple[MeshPart, ...], mesh: Mesh) -> list[MeshPart]:
    if mesh.submesh is None:
        return list(parts)
    chosen = [part for part in parts if part.name == mesh.submesh]
    if not chosen:
        names = ", ".join(sorted({part.name for part in parts if part.name})) or "none with a name"
        raise FormatError(
            f"the mesh has no submesh '{mesh.submesh}'",
            source=mesh.source,
            hint=f"there are: {names}",
        )
    return chosen


def _joined(parts: list[MeshPart]) -> MeshData:
    if len(parts) == 1:
        return MeshData(parts[0].vertices, parts[0].faces)
    starts = np.cumsum([0, *(len(part.vertices) for part in parts[:-1])])
    return MeshData(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate(
            [part.faces + np.int32(start) for part, start in zip(parts, starts, strict=True)]
        ),
    )
