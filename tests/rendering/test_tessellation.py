"""Shapes as triangles: closed, of the right volume, with normals that point outwards."""

import math

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from gazelle.description import Box, Capsule, Cone, Cylinder, Ellipsoid, Plane, Polyline, Sphere
from gazelle.rendering.shape_meshes import triangles_of
from gazelle.rendering.tessellation import creased, terrain

size = st.floats(0.05, 3.0)
SHAPES = st.one_of(
    st.builds(Box, st.tuples(size, size, size)),
    st.builds(Sphere, size),
    st.builds(Cylinder, size, size),
    st.builds(Capsule, size, size),
    st.builds(Ellipsoid, st.tuples(size, size, size)),
    st.builds(Cone, size, size),
)


def volume(shape):
    """Return the volume of the true shape [m^3]."""
    match shape:
        case Box():
            return math.prod(shape.size)
        case Sphere():
            return 4.0 / 3.0 * math.pi * shape.radius**3
        case Cylinder():
            return math.pi * shape.radius**2 * shape.length
        case Capsule():
            return math.pi * shape.radius**2 * (shape.length + 4.0 / 3.0 * shape.radius)
        case Ellipsoid():
            return 4.0 / 3.0 * math.pi * math.prod(shape.radii)
        case Cone():
            return math.pi / 3.0 * shape.radius**2 * shape.length


@given(SHAPES)
def test_solids_are_closed_and_nearly_of_their_volume(shape):
    made = triangles_of(shape)
    solid = trimesh.Trimesh(made.vertices, made.faces, process=True)
    assert solid.is_watertight
    assert 0.93 * volume(shape) < solid.volume <= volume(shape) * (1 + 1e-9)


@given(SHAPES)
def test_normals_are_of_unit_length_and_near_those_of_the_faces(shape):
    made = triangles_of(shape)
    assert np.allclose(np.linalg.norm(made.normals, axis=1), 1.0)
    a, b, c = (made.vertices[made.faces[:, k]] for k in range(3))
    flat = np.cross(b - a, c - a)
    sizes = np.linalg.norm(flat, axis=1)
    kept = sizes > 1e-9
    mean = made.normals[made.faces].mean(axis=1)[kept]
    assert ((mean * flat[kept]).sum(axis=1) / sizes[kept] > 0.3).all()


def test_a_mesh_is_smooth_where_it_bends_little_and_has_edges_where_it_bends_much():
    ball = trimesh.creation.icosphere(3)
    made = creased(np.asarray(ball.vertices), np.asarray(ball.faces, np.int32))
    assert len(made.vertices) == len(ball.vertices)
    assert np.abs(made.normals - made.vertices).max() < 0.02
    cube = trimesh.creation.box((1.0, 2.0, 3.0))
    made = creased(np.asarray(cube.vertices), np.asarray(cube.faces, np.int32))
    assert len(made.vertices) == 24
    assert sorted(map(tuple, np.unique(np.round(made.normals, 9) + 0.0, axis=0))) == sorted(
        tuple(side * axis) for axis in np.eye(3) + 0.0 for side in (-1.0, 1.0)
    )
    assert not made.two_sided


def test_an_open_mesh_and_one_inside_out_show_both_sides():
    cube = trimesh.creation.box((1.0, 1.0, 1.0))
    vertices, faces = np.asarray(cube.vertices), np.asarray(cube.faces, np.int32)
    assert creased(vertices, faces[:-1]).two_sided
    assert creased(vertices, faces[:, ::-1]).two_sided


@pytest.mark.parametrize("normal", [(0, 0, 1), (0, 0, -1), (1, 0, 0), (0.3, -0.5, 0.2)])
def test_a_plane_has_its_size_and_faces_its_normal(normal):
    made = triangles_of(Plane(normal, (2.0, 3.0)))
    a, b, c = (made.vertices[made.faces[:, k]] for k in range(3))
    areas = np.cross(b - a, c - a) / 2.0
    unit = np.asarray(normal) / np.linalg.norm(normal)
    assert np.allclose(areas.sum(axis=0), 6.0 * unit)


def test_an_outline_stands_between_zero_and_its_height():
    shape = Polyline((((0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 0.4), (0.0, 1.0)),), 0.5)
    made = triangles_of(shape)
    assert made.vertices[:, 2].min() == 0.0
    assert made.vertices[:, 2].max() == 0.5


def test_terrain_has_normals_of_its_slope():
    x = np.linspace(-1.0, 1.0, 5)
    made = terrain(np.tile(0.5 * x, (4, 1)), (2.0, 3.0))
    assert np.allclose(made.normals, np.array([-0.5, 0.0, 1.0]) / math.hypot(0.5, 1.0))
    a, b, c = (made.vertices[made.faces[:, k]] for k in range(3))
    assert (np.cross(b - a, c - a)[:, 2] > 0.0).all()
    assert made.vertices[:, 1].min() == -1.5
