"""Meshes that cannot be are refused when they are made, and what is made can be cut."""

import numpy as np
import pytest
import wrong_values

from gazelle.errors import FormatError
from gazelle.geometry.convex_decomposition import decompose
from gazelle.geometry.mesh_data import MeshData

VERTICES = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
FACES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], np.int32)
NUMBERS = [
    np.asarray(each, float)
    for place, each in enumerate(wrong_values.ARRAYS)
    if place not in wrong_values.NO_FLOATS
]


@pytest.mark.parametrize("vertices", [v for v in NUMBERS if v.shape != (7, 3)], ids=repr)
def test_vertices_that_cannot_be(vertices):
    with pytest.raises(FormatError, match=r"finite|triangles|ints|cannot take"):
        MeshData(vertices, FACES)


@pytest.mark.parametrize(
    "faces",
    [[], [-1], [[0]], [[0, 1, 9]], [[0, 1, -1]], [[0.0, 1.0, 2.0]], [[0, 1, 2**40]]],
    ids=repr,
)
def test_faces_that_cannot_be(faces):
    with pytest.raises(FormatError, match="three"):
        MeshData(VERTICES, np.array(faces))


@pytest.mark.parametrize("static", [True, False])
@pytest.mark.parametrize("scale", [0.0, 1e-300, 1e-9, 1e-5, 1e14])
def test_odd_meshes_are_cut(scale, static):
    pieces = decompose(MeshData(VERTICES * scale, FACES), static=static)
    assert len(pieces.solids) == (1 if scale > 1e-9 else 0)
    assert np.isfinite(pieces.gap)
