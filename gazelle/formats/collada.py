"""COLLADA (DAE) files, through pycollada.

Node transforms and the file's unit are applied. The up-axis is not: Gazebo classic and
RViz do not turn meshes by it either, and many files of robots (Kobuki's, TurtleBot3's)
declare Y_UP by mistake of their exporter, though z is up. Of materials the diffuse colour or picture is
read; lights, cameras and animations play no part.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterator
from itertools import count
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import FormatError
from gazelle.formats import xml
from gazelle.formats.limits import MAX_NODES, MAX_TRIANGLES
from gazelle.formats.mesh_materials import PLAIN, MeshMaterial

Piece = tuple[str, NDArray[np.float64], NDArray[np.int32], MeshMaterial]

MAX_DEPTH = 64


def parse(data: bytes) -> list[Piece]:
    """Parse name, vertices (n, 3), faces (m, 3) and material of each geometry in the scene.

    Raises:
        FormatError: The file is no valid COLLADA, or holds no scene.
    """
    xml.parse(data, name="mesh")  # refuses entities and broken XML before another parser sees it
    document = _document(data)
    if document.scene is None:
        raise FormatError("the COLLADA file has no scene")
    metre = _metre(document)
    pieces: list[Piece] = []
    visits, triangles = count(1), 0
    for node in document.scene.nodes:
        for found, matrix in _instances(node, np.eye(4), 0, visits):
            geometry = _geometry(found)
            name, materials = geometry.name or geometry.id or "", _materials(found)
            for primitive in geometry.primitives:
                material = materials.get(primitive.material, PLAIN)
                for piece in _piece(name, primitive, material, matrix, metre):
                    pieces.append(piece)
                    triangles += len(piece[2])
            if triangles > MAX_TRIANGLES:
                raise FormatError(
                    f"the scene has more than the limit of {MAX_TRIANGLES:,} triangles",
                    hint="every instance of a node counts",
                )
    return pieces


def _metre(document: Any) -> float:
    """Return the file's unit [m]."""
    found = document.assetInfo.unitmeter
    metre = 1.0 if found is None else float(found)
    if not 0.0 < metre < math.inf:
        raise FormatError(f"the unit of the COLLADA file must be positive, found {metre:g}")
    return metre


def _document(data: bytes) -> Any:
    """Return pycollada's document; objects with a broken material have none.

    Gazebo shows such geometries, and pycollada leaves them out.
    """
    import collada

    ignored = [collada.common.DaeError]
    document = collada.Collada(io.BytesIO(data), ignore=ignored)
    if not document.errors:
        return document
    known = {f"#{material.id}" for material in document.materials}
    root = ET.fromstring(data)  # noqa: S314  # what is dangerous was refused
    broken = [
        (bindings, binding)
        for bindings in root.iterfind(".//{*}technique_common")
        for binding in bindings.findall("{*}instance_material")
        if binding.get("target") not in known
    ]
    if not broken:
        return document
    for bindings, binding in broken:
        bindings.remove(binding)
    return collada.Collada(io.BytesIO(ET.tostring(root)), ignore=ignored)


def _instances(
    node: Any, outer: NDArray[np.float64], depth: int, visits: Iterator[int]
) -> Iterator[tuple[Any, NDArray[np.float64]]]:
    """Yield each node of the scene that places a geometry, with its transform."""
    if next(visits) > MAX_NODES:
        raise FormatError(
            f"the scene has more than the limit of {MAX_NODES:,} nodes",
            hint="every <instance_node> counts",
        )
    if depth > MAX_DEPTH:
        raise FormatError(f"the scene has nodes nested more than {MAX_DEPTH} deep")
    kind = type(node).__name__
    if kind in {"GeometryNode", "ControllerNode"}:
        if _geometry(node) is not None:
            yield node, outer
        return
    matrix = outer
    if kind in {"Node", "NodeNode"}:
        matrix = outer @ np.asarray(node.matrix, np.float64)
    for child in getattr(node, "children", None) or ():
        yield from _instances(child, matrix, depth + 1, visits)


def _geometry(node: Any) -> Any:
    return getattr(node, "geometry", None) or getattr(node.controller, "geometry", None)


def _materials(node: Any) -> dict[str, MeshMaterial]:
    """Return the materials that primitives name by symbols."""
    return {bound.symbol: _mesh_material(bound.target) for bound in node.materials}


def _mesh_material(material: Any) -> MeshMaterial:
    diffuse = getattr(getattr(material, "effect", None), "diffuse", None)
    if isinstance(diffuse, tuple | list) and len(diffuse) >= len("rgb"):
        red, green, blue = (min(max(float(share), 0.0), 1.0) for share in diffuse[:3])
        return MeshMaterial((red, green, blue))
    image = getattr(getattr(getattr(diffuse, "sampler", None), "surface", None), "image", None)
    return MeshMaterial(texture=str(getattr(image, "path", "") or ""))


def _piece(
    name: str, primitive: Any, material: MeshMaterial, matrix: NDArray[np.float64], metre: float
) -> Iterator[Piece]:
    triangles = primitive
    if hasattr(primitive, "triangleset"):
        triangles = primitive.triangleset()
    index = getattr(triangles, "vertex_index", None)
    if index is None or not len(index) or np.shape(index)[-1] != 3:
        return  # lines
    used, inverse = np.unique(index, return_inverse=True)
    points = np.asarray(triangles.vertex, np.float64)[used]
    placed = points @ matrix[:3, :3].T + matrix[:3, 3]
    faces, uv = inverse.reshape(-1, 3).astype(np.int32), _uv(triangles)
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        faces, uv = faces[:, ::-1], None if uv is None else uv[:, ::-1]
    textured = MeshMaterial(material.color, material.texture, uv if material.texture else None)
    yield name, placed * metre, np.ascontiguousarray(faces), textured


def _uv(triangles: Any) -> NDArray[np.float64] | None:
    """Return the texture coordinates of the corners, shape (m, 3, 2); None without any."""
    if not triangles.texcoordset or not len(triangles.texcoordset[0]):
        return None
    places = np.asarray(triangles.texcoordset[0], np.float64)[:, :2]
    index = np.asarray(triangles.texcoord_indexset[0])
    found: NDArray[np.float64] = places[np.clip(index, 0, len(places) - 1)]
    return found
