"""Solids as triangles: closed, seen from outside, and as large as formulas say."""

import math

import numpy as np
import pytest

from gazelle.geometry import triangles

SOLIDS = {
    "box": (lambda _: triangles.box((1.0, 2.0, 3.0)), 6.0),
    "ball": (lambda n: triangles.ellipsoid((0.5,) * 3, n), math.pi / 6.0),
    "ellipsoid": (lambda n: triangles.ellipsoid((0.5, 1.0, 2.0), n), 4.0 / 3.0 * math.pi),
    "capsule": (lambda n: triangles.capsule(0.5, 2.0, n), math.pi * (0.5 + 1.0 / 6.0)),
    "cylinder": (lambda n: triangles.frustum(0.5, 0.5, 2.0, n), math.pi / 2.0),
    "cone": (lambda n: triangles.frustum(0.5, 0.0, 3.0, n), math.pi / 4.0),
}


@pytest.mark.parametrize("sides", [16, 64])
@pytest.mark.parametrize("name", SOLIDS)
def test_solids_are_closed_and_hold_what_formulas_say(name, sides):
    make, volume = SOLIDS[name]
    made = make(sides)
    corners = made.vertices[made.faces]
    found = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6.0
    assert found == pytest.approx(volume, rel=20.0 / sides**2)
    _, welded = np.unique(np.round(made.vertices, 9), axis=0, return_inverse=True)
    edges = welded.reshape(-1)[made.faces][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    assert sorted(map(tuple, edges.tolist())) == sorted(map(tuple, edges[:, ::-1].tolist()))


@pytest.mark.parametrize("name", SOLIDS)
def test_normals_are_of_length_one_and_look_outwards(name):
    made = SOLIDS[name][0](32)
    assert np.linalg.norm(made.normals, axis=1) == pytest.approx(1.0)
    corners = made.vertices[made.faces]
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (np.einsum("ik,ijk->ij", flat, made.normals[made.faces]) > 0.0).all()


def test_what_has_no_size_has_no_triangles():
    assert len(triangles.ellipsoid((0.0, 0.0, 0.0)).faces) == 0
