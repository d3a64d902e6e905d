"""COLLADA (DAE) files, through pycollada.

Node transforms and the file's unit are applied. The up-axis is not: Gazebo classic and
RViz do not turn meshes by it either, and many files of robots (Kobuki's, TurtleBot3's)
say Y_UP by mistake of their exporter, though z is up. Textures, lights, cameras and
animations play no part.
"""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import FormatError
from gazelle.formats import xml

Piece = tuple[str, NDArray[np.float64], NDArray[np.int32]]

MAX_DEPTH = 64


def parse(data: bytes) -> list[Piece]:
    """Name, vertices (n, 3) and faces (m, 3) of each geometry where the scene puts it.

    Raises:
        FormatError: The file is no valid COLLADA, or holds no scene.
    """
    xml.parse(data, name="mesh")  # refuses entities and broken XML before another parser sees it
    import collada

    document = collada.Collada(io.BytesIO(data), ignore=[collada.common.DaeError])
    if document.scene is None:
        raise FormatError("the COLLADA file has no scene")
    metre = float(document.assetInfo.unitmeter or 1.0)
    pieces: list[Piece] = []
    for node in document.scene.nodes:
        for name, geometry, matrix in _instances(node, np.eye(4), 0):
            pieces.extend(_pieces(name, geometry, matrix, metre))
    return pieces


def _instances(
    node: Any, outer: NDArray[np.float64], depth: int
) -> Iterator[tuple[str, Any, NDArray[np.float64]]]:
    """Each geometry in the scene with the name of its node and its transform."""
    if depth > MAX_DEPTH:
        raise FormatError(f"the scene has nodes nested more than {MAX_DEPTH} deep")
    kind = type(node).__name__
    if kind in {"GeometryNode", "ControllerNode"}:
        geometry = getattr(node, "geometry", None) or getattr(node.controller, "geometry", None)
        if geometry is not None:
            yield geometry.name or geometry.id or "", geometry, outer
        return
    matrix = outer
    if kind in {"Node", "NodeNode"}:
        matrix = outer @ np.asarray(node.matrix, np.float64)
    for child in getattr(node, "children", None) or ():
        yield from _instances(child, matrix, depth + 1)


def _pieces(name: str, geometry: Any, matrix: NDArray[np.float64], metre: float) -> Iterator[Piece]:
    for primitive in geometry.primitives:
        triangles = primitive
        if hasattr(primitive, "triangleset"):
            triangles = primitive.triangleset()
        index = getattr(triangles, "vertex_index", None)
        if index is None or not len(index) or np.shape(index)[-1] != 3:
            continue  # lines
        used, inverse = np.unique(index, return_inverse=True)
        points = np.asarray(triangles.vertex, np.float64)[used]
        placed = points @ matrix[:3, :3].T + matrix[:3, 3]
        faces = inverse.reshape(-1, 3).astype(np.int32)
        if np.linalg.det(matrix[:3, :3]) < 0.0:
            faces = faces[:, ::-1]
        yield name, placed * metre, np.ascontiguousarray(faces)
