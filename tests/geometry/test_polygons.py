"""Outlines become convex polygons that cover just what they enclose."""

import math
import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.geometry.polygons import convex_polygons, planar_area, planar_hull

SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]
HOLE = [(1, 1), (3, 1), (3, 3), (1, 3)]


def total(polygons):
    return sum(planar_area(polygon) for polygon in polygons)


@pytest.mark.parametrize(
    ("outlines", "area", "count"),
    [
        ([SQUARE], 16, 1),
        ([SQUARE[::-1]], 16, 1),
        ([[*SQUARE, SQUARE[0]]], 16, 1),
        ([[(0, 0), (2, 1), (0, 2), (-2, 1)]], 4, 1),
        ([SQUARE, HOLE], 12, 4),
        ([SQUARE, HOLE, [(1.5, 1.5), (2.5, 1.5), (2.5, 2.5), (1.5, 2.5)]], 13, 5),
        ([[(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]], 3, 2),
        ([SQUARE, [(6, 0), (7, 0), (7, 1)]], 16.5, 2),
        ([], 0, 0),
        ([[(0, 0), (1, 1)]], 0, 0),
        ([[(0, 0), (1, 0), (2, 0)]], 0, 0),
    ],
)
def test_area_and_number(outlines, area, count):
    found = convex_polygons(outlines)
    assert total(found) == pytest.approx(area)
    assert len(found) == count


@settings(max_examples=100, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(3, 25))
def test_any_star_is_covered_by_convex_polygons(seed, count):
    chance = np.random.default_rng(seed)
    angles = 2 * np.pi * (np.arange(count) + chance.uniform(0, 0.4, count)) / count
    radii = chance.uniform(0.2, 1.0, count)
    star = np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)
    found = convex_polygons([list(map(tuple, star))])
    assert total(found) == pytest.approx(abs(planar_area(star)), abs=1e-6)
    for polygon in found:
        assert planar_area(polygon[planar_hull(polygon)]) == pytest.approx(planar_area(polygon))


def test_a_star_of_many_points_takes_a_second():
    """Hulls with all parts below would take twelve seconds."""
    corners = [
        (radius * math.cos(angle), radius * math.sin(angle))
        for radius, angle in ((1 + 2 * (n % 2), 2 * math.pi * n / 400) for n in range(400))
    ]
    start = time.process_time()
    parts = convex_polygons([corners])
    assert time.process_time() - start < 5.0
    whole = abs(planar_area(np.array(corners)))
    assert math.isclose(sum(map(planar_area, parts)), whole, rel_tol=1e-9)
