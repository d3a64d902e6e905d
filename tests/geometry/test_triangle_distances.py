"""Distances of points from triangles are those of the nearest triangle."""

import numpy as np
import pytest
import trimesh

from gazelle.geometry.surface import clean

SHAPES = {
    "ring": trimesh.creation.annulus(0.1, 0.2, 0.3),
    "ball": trimesh.creation.icosphere(subdivisions=2, radius=0.2),
    "one triangle": trimesh.Trimesh([[0, 0, 0], [0.3, 0, 0], [0.1, 0.2, 0]], [[0, 1, 2]]),
}


@pytest.mark.parametrize("name", SHAPES)
def test_distances_are_those_of_the_nearest_triangle(name):
    mesh = SHAPES[name]
    surface = clean(mesh.vertices, np.asarray(mesh.faces, np.int32))
    points = np.random.default_rng(0).uniform(-0.4, 0.4, (500, 3))
    expected = trimesh.proximity.closest_point_naive(mesh, points)[1]
    # Corners are welded to a two-millionth of the size.
    np.testing.assert_allclose(surface.distances.of(points), expected, atol=1e-6)


def test_what_is_near_enough_is_looked_at_no_closer():
    mesh = SHAPES["ring"]
    surface = clean(mesh.vertices, np.asarray(mesh.faces, np.int32))
    points = np.random.default_rng(0).uniform(-0.4, 0.4, (2000, 3))
    exact, found = surface.distances.of(points), surface.distances.of(points, 0.1)
    far = exact > 0.1
    assert 0 < far.sum() < len(far)
    np.testing.assert_array_equal(found > 0.1, far)
    np.testing.assert_array_equal(found[far], exact[far])
    assert (found >= exact).all()
    assert (found[~far] > exact[~far]).any()
