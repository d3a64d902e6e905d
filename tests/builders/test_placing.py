"""Zones, free places and footprints."""

import itertools
import math

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gazelle.builders import BuildError, Disc, Rectangle, along, box, footprints, ground, scatter
from gazelle.description import Pose
from gazelle.streams import Stream

coordinates = st.floats(-5.0, 5.0)


@given(
    coordinates, coordinates, coordinates, coordinates, st.floats(0.1, 3.0), st.floats(-4.0, 4.0)
)
def test_distances_do_not_depend_on_the_frame(x, y, px, py, length, turn):
    plain = Rectangle(0.0, 0.0, length, 1.0)
    frame = Pose(x, y, yaw=turn)
    moved = Rectangle(x, y, length, 1.0, turn)
    there = frame.apply((px, py, 0.0))
    assert moved.distance(*there[:2]) == pytest.approx(plain.distance(px, py), abs=1e-9)


def test_distance_is_to_the_nearest_point():
    zone = Rectangle(0.0, 0.0, 4.0, 2.0)
    assert zone.distance(5.0, 0.0) == 3.0
    assert zone.distance(5.0, 5.0) == 5.0
    assert zone.distance(0.0, 0.0) == -1.0
    assert Disc(1.0, 0.0, 2.0).distance(5.0, 0.0) == 2.0


@settings(max_examples=50, deadline=None)
@given(
    st.integers(0, 2**32),
    st.lists(st.floats(0.1, 0.5), max_size=10),
    st.floats(0.0, 0.3),
    st.floats(-3.0, 3.0),
)
def test_places_are_apart_inside_and_clear(seed, radii, gap, turn):
    area = Rectangle(1.0, -1.0, 8.0, 7.0, turn)
    zones = [Disc(1.0, -1.0, 1.0), Rectangle(3.0, 0.0, 1.0, 2.0, 0.5)]
    places = scatter(radii, area, Stream(seed, "test", 1), keep_clear=zones, gap=gap)
    assert [place.radius for place in places] == radii
    for a, b in itertools.combinations(places, 2):
        assert math.dist((a.x, a.y), (b.x, b.y)) >= a.radius + b.radius + gap - 1e-9
    for place in places:
        assert area.distance(place.x, place.y) <= -place.radius + 1e-9
        for zone in zones:
            assert zone.distance(place.x, place.y) >= place.radius + gap - 1e-9


def test_a_full_area_is_an_error():
    with pytest.raises(BuildError, match="of 100 things found room"):
        scatter([0.5] * 100, Rectangle(0, 0, 4, 4), Stream(0, "test", 1))
    with pytest.raises(BuildError, match="only 0 of 1"):
        scatter([3.0], Rectangle(0, 0, 4, 4), Stream(0, "test", 1))


@given(coordinates, coordinates, st.floats(-3.0, 3.0), st.floats(0.1, 2.0))
def test_an_upright_box_covers_what_it_covers(x, y, yaw, length):
    (found,) = footprints(box("b", (length, 0.5, 1.0), pose=Pose(x, y, yaw=yaw)))
    corner = Pose(x, y, yaw=yaw).apply((length / 2, 0.25, 0.0))
    assert found.distance(*corner[:2]) == pytest.approx(0.0, abs=1e-9)
    assert found.length * found.width == pytest.approx(length * 0.5)


def test_planes_cover_nothing():
    assert footprints(ground()) == []


@given(
    st.lists(st.tuples(coordinates, coordinates), min_size=2, max_size=5),
    st.floats(0.0, 1.0),
    st.floats(-0.99, 0.99),
)
def test_a_strip_covers_both_sides_of_its_line(points, share, aside):
    (x0, y0), (x1, y1) = points[:2]
    length = math.dist((x0, y0), (x1, y1))
    assume(length > 1e-3)
    x = x0 + share * (x1 - x0) - aside * (y1 - y0) / length
    y = y0 + share * (y1 - y0) + aside * (x1 - x0) / length
    assert min(zone.distance(x, y) for zone in along(points, 2.0)) <= 0.0
