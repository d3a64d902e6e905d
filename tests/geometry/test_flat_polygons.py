"""Polygons joined from triangles: flat and convex within the tolerance, and all of the surface."""

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.geometry.flat_polygons import Polygons
from gazelle.geometry.surface import clean


def joined(mesh, tolerance):
    surface = clean(np.asarray(mesh.vertices), np.asarray(mesh.faces, np.int32))
    polygons = Polygons(surface)
    polygons.join(1e-6 * surface.size, notches=False)
    if tolerance:
        polygons.join(tolerance, notches=True)
    return surface, polygons, polygons.rims()


def wavy(subdivisions=4):
    mesh = trimesh.creation.icosphere(subdivisions=subdivisions)
    mesh.vertices[:, 2] += 0.2 * np.sin(9.0 * mesh.vertices[:, 0])
    return mesh


def rough(seed, count, height):
    chance = np.random.default_rng(seed)
    x, y = np.meshgrid(np.linspace(0, 3, count), np.linspace(0, 3, count))
    z = chance.uniform(0.0, height, x.shape)
    a = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    faces = np.concatenate(
        [np.stack([a, a + 1, a + count + 1], 1), np.stack([a, a + count + 1, a + count], 1)]
    )
    return trimesh.Trimesh(np.column_stack([x.ravel(), y.ravel(), z.ravel()]), faces)


def check(surface, rims, tolerance):
    """Check that a polygon's vertices lie in a slab, and that its rim is convex in its plane."""
    corners = surface.vertices[surface.faces]
    heights = np.einsum("ijk,ik->ij", corners, rims.normals[rims.owners])
    for owner in range(len(rims.sizes)):
        assert np.ptp(heights[rims.owners == owner]) <= tolerance + 1e-9
    for rim, normal in zip(
        np.split(rims.vertices, np.cumsum(rims.sizes)[:-1]), rims.normals, strict=True
    ):
        sides = surface.vertices[np.roll(rim, -1)] - surface.vertices[rim]
        sides -= np.outer(sides @ normal, normal)
        turns = np.cross(sides, np.roll(sides, -1, axis=0)) @ normal
        assert turns.min() >= -1e-6 * np.einsum("ij,ij->i", sides, sides).max()


@pytest.mark.parametrize("tolerance", [0.002, 0.01, 0.05])
@pytest.mark.parametrize("mesh", [wavy(), trimesh.creation.torus(1.0, 0.3)], ids=["wavy", "torus"])
def test_polygons_of_curved_surfaces_are_flat_and_convex(mesh, tolerance):
    surface, polygons, rims = joined(mesh, tolerance)
    assert len(rims.sizes) == polygons.count < len(surface.faces)
    check(surface, rims, tolerance)


@settings(max_examples=25)
@given(st.integers(0, 2**32 - 1), st.integers(3, 14), st.sampled_from([0.0, 1e-3, 0.05, 0.5]))
def test_polygons_of_rough_ground_are_flat_and_convex(seed, count, height):
    surface, _, rims = joined(rough(seed, count, height), 0.01)
    check(surface, rims, 0.01)
    if not height:
        assert len(rims.sizes) == 1


def test_flat_sides_become_one_polygon_each():
    box = trimesh.creation.box((1, 2, 3)).subdivide().subdivide()
    surface, _, rims = joined(box, 0.0)
    assert len(rims.sizes) == 6
    area = np.bincount(rims.owners, surface.areas)
    np.testing.assert_allclose(sorted(area), [2, 2, 3, 3, 6, 6])


def test_polygons_cover_what_their_triangles_do():
    """Where nothing is filled, the rim's area is that of the triangles."""
    surface, _, rims = joined(trimesh.creation.annulus(0.5, 1.0, 0.3, sections=40), 0.0)
    for owner, rim in enumerate(np.split(rims.vertices, np.cumsum(rims.sizes)[:-1])):
        points = surface.vertices[rim] - surface.vertices[rim[0]]
        doubled = np.cross(points[:-1], points[1:]).sum(axis=0) @ rims.normals[owner]
        area = surface.areas[rims.owners == owner].sum()
        assert doubled / 2.0 == pytest.approx(area, rel=1e-6)


def test_the_same_surface_gives_the_same_polygons():
    first, again = (joined(wavy(3), 0.01)[2] for _ in "12")
    np.testing.assert_array_equal(first.vertices, again.vertices)


@pytest.mark.long
def test_a_large_curved_surface_takes_seconds_not_half_a_minute():
    import time

    mesh = trimesh.creation.torus(1.0, 0.3, major_sections=270, minor_sections=270)
    start = time.process_time()
    _, polygons, _ = joined(mesh, 0.007)
    assert time.process_time() - start < 8.0  # by loops over edges it took over ten
    assert polygons.count < 12_000
