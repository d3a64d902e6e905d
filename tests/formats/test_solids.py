"""Inertias that are computed from shapes, against random points and other ways."""

import math

import numpy as np
import pytest
import trimesh
from xml_samples import model

from gazelle import FormatError, Pose
from gazelle.description import Box, Capsule, Cone, Cylinder, Ellipsoid, Polyline, Sphere
from gazelle.errors import FormatWarning
from gazelle.formats.solids import solid_of
from gazelle.geometry.solids import joined


def auto(collisions, inertial=""):
    text = f"<link name='l'><inertial auto='true'>{inertial}</inertial>{collisions}</link>"
    return model(text, "1.11").links[0].inertial


def cube(name, pose="", density=""):
    return (
        f"<collision name='{name}'><pose>{pose or '0 0 0 0 0 0'}</pose>{density}"
        "<geometry><box><size>1 1 1</size></box></geometry></collision>"
    )


def test_inertias_are_computed():
    plain = auto(cube("a"))
    assert plain.mass == pytest.approx(1000)
    assert plain.inertia.ixx == pytest.approx(1000 / 6)
    assert auto(cube("a"), "<density>6</density>").mass == pytest.approx(6)
    heavy = auto(cube("a", density="<density>3</density>"), "<density>6</density>")
    assert heavy.mass == pytest.approx(3)
    scaled = auto(cube("a"), "<mass>12</mass>")
    assert (scaled.mass, scaled.inertia.iyy) == pytest.approx((12, 2))
    pair = auto(cube("a", "1 0 0 0 0 0") + cube("b", "-1 0 0 0 0 0.3", "<density>3000</density>"))
    assert pair.pose.position == pytest.approx((-0.5, 0, 0))
    assert pair.inertia.izz == pytest.approx(4000 / 6 + 1000 * 1.5**2 + 3000 * 0.5**2)


def test_no_shape_gives_the_default():
    with pytest.warns(FormatWarning, match="no collision of the link has a volume"):
        assert auto("").mass == 1.0
    with pytest.raises(FormatError, match="<density> must be greater than zero"):
        auto(cube("a"), "<density>-1</density>")


@pytest.mark.parametrize(
    "shape",
    [
        Box((1.0, 2.0, 3.0)),
        Sphere(0.7),
        Cylinder(0.5, 2.0),
        Capsule(0.5, 1.5),
        Ellipsoid((0.5, 1.0, 1.5)),
        Cone(0.8, 2.0),
        Polyline((((0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)),), 0.5),
    ],
)
def test_closed_forms_agree_with_random_points(shape):
    chance = np.random.default_rng(0)
    points = chance.uniform(-1.6, 2.1, (400_000, 3))
    points = points[inside(shape, points)]
    volume = 3.7**3 * len(points) / 400_000
    found = solid_of(shape)
    assert found.volume == pytest.approx(volume, rel=0.03)
    np.testing.assert_allclose(found.center, points.mean(axis=0), atol=0.03)
    away = points - found.center
    second = away.T @ away / len(points) * found.volume
    inertia = np.trace(second) * np.eye(3) - second
    np.testing.assert_allclose(found.inertia, inertia, atol=0.04 * np.trace(inertia))


def inside(shape, points):
    x, y, z = points.T
    r = np.hypot(x, y)
    if isinstance(shape, Box):
        return (np.abs(points) <= np.array(shape.size) / 2).all(axis=1)
    if isinstance(shape, Sphere):
        return np.linalg.norm(points, axis=1) <= shape.radius
    if isinstance(shape, Cylinder):
        return (r <= shape.radius) & (np.abs(z) <= shape.length / 2)
    if isinstance(shape, Capsule):
        beyond = np.maximum(np.abs(z) - shape.length / 2, 0)
        return np.hypot(r, beyond) <= shape.radius
    if isinstance(shape, Ellipsoid):
        return np.linalg.norm(points / shape.radii, axis=1) <= 1
    if isinstance(shape, Cone):
        return (r <= shape.radius * (0.5 - z / shape.length)) & (z >= -shape.length / 2)
    low = (z >= 0) & (z <= shape.height) & (x >= 0) & (y >= 0)
    return low & (((x <= 2) & (y <= 1)) | ((x <= 1) & (y <= 2)))


def test_parts_join_into_the_whole():
    half = solid_of(Box((1.0, 2.0, 3.0)))
    whole = joined(
        [half.placed(Pose(x=0.5).matrix()), half.placed(Pose(x=-0.5, yaw=math.pi).matrix())]
    )
    np.testing.assert_allclose(whole.inertia, solid_of(Box((2.0, 2.0, 3.0))).inertia, atol=1e-12)


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
