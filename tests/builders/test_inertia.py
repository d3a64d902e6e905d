"""Inertias are those of solid bodies: compared with meshes of the same shapes."""

import math

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.builders import BuildError, solid_inertial
from gazelle.description import Box, Capsule, Cone, Cylinder, Ellipsoid, Plane, Pose, Sphere
from gazelle.formats.solids import solid_of


def mesh_of(shape):
    make = trimesh.creation
    if isinstance(shape, Box):
        return make.box(shape.size)
    if isinstance(shape, Cylinder):
        return make.cylinder(shape.radius, shape.length, sections=200)
    if isinstance(shape, Capsule):
        mesh = make.capsule(shape.length, shape.radius, count=(100, 100))
        mesh.apply_translation(-mesh.center_mass)
        return mesh
    if isinstance(shape, Cone):
        mesh = make.cone(shape.radius, shape.length, sections=200)
        mesh.apply_translation((0, 0, -shape.length / 2))
        return mesh
    mesh = make.icosphere(5)
    mesh.apply_scale((shape.radius,) * 3 if isinstance(shape, Sphere) else shape.radii)
    return mesh


SHAPES = [
    Box((0.3, 0.5, 0.7)),
    Cylinder(0.2, 0.9),
    Capsule(0.2, 0.5),
    Cone(0.3, 0.8),
    Ellipsoid((0.2, 0.3, 0.5)),
    Sphere(0.4),
]


@pytest.mark.parametrize("shape", SHAPES, ids=lambda s: type(s).__name__)
def test_volume_center_and_moments_are_those_of_a_mesh(shape):
    mesh, solid = mesh_of(shape), solid_of(shape)
    assert solid.volume == pytest.approx(mesh.volume, rel=3e-3)
    assert tuple(solid.center) == pytest.approx(tuple(mesh.center_mass), abs=1e-3)
    expected = np.diag(mesh.moment_inertia) / mesh.volume
    assert tuple(np.diag(solid.inertia) / solid.volume) == pytest.approx(tuple(expected), rel=6e-3)


def test_two_halves_are_one_box():
    whole = solid_inertial([(Box((1.0, 0.4, 0.2)), Pose())], 3.0)
    halves = [(Box((0.5, 0.4, 0.2)), Pose(x=x)) for x in (-0.25, 0.25)]
    both = solid_inertial(halves, 3.0)
    assert both.pose.is_close(whole.pose)
    for name in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"):
        assert getattr(both.inertia, name) == pytest.approx(getattr(whole.inertia, name))


lengths = st.floats(0.05, 2.0)
angles = st.floats(-3.0, 3.0)
poses = st.builds(Pose, angles, angles, angles, angles, angles, angles)


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.tuples(st.builds(lambda *s: Box(s), lengths, lengths, lengths), poses), min_size=1),
    st.floats(0.1, 100.0),
)
def test_an_inertia_is_possible(parts, mass):
    a, b, c = np.linalg.eigvalsh(solid_inertial(parts, mass).inertia.matrix())
    assert a > 0.0
    assert a + b >= c * (1.0 - 1e-9)


def test_what_has_no_inertia_is_refused():
    with pytest.raises(BuildError, match="a plane has no volume"):
        solid_inertial([(Plane(), Pose())], 1.0)
    with pytest.raises(BuildError, match="without shapes"):
        solid_inertial([], 1.0)
    with pytest.raises(BuildError, match="mass"):
        solid_inertial([(Sphere(1.0), Pose())], math.nan)
