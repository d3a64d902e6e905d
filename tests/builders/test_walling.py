"""Walls stand along their lines, and openings are open."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.builders import BuildError, Opening, door, room, walls, window
from gazelle.description import Pose


def boxes(model):
    return [(c.pose, c.geometry.size) for c in model.links[0].collisions]


def inside(model, point):
    """Return whether a point lies in a wall."""
    for pose, size in boxes(model):
        local = (model.pose * pose).inverse().apply(point)
        if all(abs(value) <= length / 2 + 1e-9 for value, length in zip(local, size, strict=True)):
            return True
    return False


def test_a_wall_is_solid_from_end_to_end():
    model = walls([(0, 0), (3, 4)], height=2.0, thickness=0.2)
    assert inside(model, (0.0, 0.0, 0.1))
    assert inside(model, (3.0, 4.0, 1.9))
    assert not inside(model, (3.0 + 0.1, 4.0 + 0.1, 1.0))
    assert not inside(model, (1.5, 2.0, 2.1))


def test_corners_are_closed():
    model = walls([(0, 0), (2, 0), (2, 2)], thickness=0.2)
    assert inside(model, (2.09, -0.09, 1.0))


def test_a_room_is_as_large_as_it_says():
    model = room(4.0, 3.0, thickness=0.2, pose=Pose(1.0, 1.0, yaw=0.3))
    for x, y in ((1.99, 0), (-1.99, 0), (0, 1.49), (0, -1.49)):
        assert not inside(model, model.pose.apply((x, y, 1.0)))
    for x, y in ((2.01, 0), (-2.01, 0), (0, 1.51), (0, -1.51), (2.19, 1.69)):
        assert inside(model, model.pose.apply((x, y, 1.0)))


def test_a_door_is_open_below_and_a_window_in_the_middle():
    model = walls([(0, 0), (6, 0)], openings=[door(0, 1.5), window(0, 4.0)], height=2.5)
    assert not inside(model, (1.5, 0, 0.05))
    assert not inside(model, (1.5, 0, 2.05))
    assert inside(model, (1.5, 0, 2.2))
    assert inside(model, (4.0, 0, 0.8))
    assert not inside(model, (4.0, 0, 1.5))
    assert inside(model, (4.0, 0, 2.3))


@settings(max_examples=80, deadline=None)
@given(
    st.floats(2.0, 10.0),
    st.floats(0.0, 6.3),
    st.lists(st.tuples(st.floats(0.1, 0.9), st.floats(0.1, 0.9)), max_size=4),
)
def test_openings_take_away_just_their_area(length, angle, shares):
    each = length / max(len(shares), 1)
    openings = [
        Opening(0, (i + 0.5) * each, share * each, 0.4 * low, 0.5 + low)
        for i, (share, low) in enumerate(shares)
    ]
    end = (length * math.cos(angle), length * math.sin(angle))
    model = walls([(0.0, 0.0), end], height=2.0, openings=openings)
    area = sum(size[0] * size[2] for _, size in boxes(model))
    holes = sum(o.width * (o.top - o.bottom) for o in openings)
    assert area == pytest.approx(length * 2.0 - holes)


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({"points": [(0, 0)]}, "at least 2 points"),
        ({"points": [(0, 0), (1, 0)], "closed": True}, "at least 3 points"),
        ({"points": [(0, 0), (0, 0)]}, "wall 0 has no length"),
        ({"points": [(0, 0), (math.inf, 0)]}, "finite"),
        ({"openings": [door(0, 0.2)]}, "does not fit into wall 0"),
        ({"openings": [door(0, 1.5, height=3.0)]}, "2.5 m high"),
        ({"openings": [door(0, 1.0), door(0, 1.5)]}, "overlap"),
        ({"openings": [door(3, 1.0)]}, "there is no wall 3"),
        ({"height": 0.0}, "height"),
    ],
)
def test_impossible_walls_are_refused(options, text):
    with pytest.raises(BuildError, match=text):
        walls(**{"points": [(0, 0), (3, 0)], **options})
