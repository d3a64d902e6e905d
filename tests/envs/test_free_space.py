"""Places where a robot can be, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.envs.floor_plan import FloorPlan
from gazelle.envs.free_space import PASSAGE, FreeSpace
from gazelle.errors import TaskError

TOLERANCE = 0.06  # two cells of the map [m]


def box(x0, y0, x1, y1):
    return [(x0, y0, x1, y0), (x1, y0, x1, y1), (x1, y1, x0, y1), (x0, y1, x0, y0)]


def space(segments, discs=(), start=(0.0, 0.0)):
    return FreeSpace(FloorPlan(np.array(segments), np.array(discs).reshape(-1, 3)), start)


def distance_to_segments(points, segments):
    """Return the distance of each point from the nearest of all [m]."""
    best = np.full(len(points), np.inf)
    for x0, y0, x1, y1 in segments:
        along, rel = np.array([x1 - x0, y1 - y0]), points - [x0, y0]
        share = np.clip(rel @ along / (along @ along), 0.0, 1.0)
        best = np.minimum(best, np.hypot(*(rel - share[:, None] * along).T))
    return best


@given(
    width=st.floats(1.5, 12.0), depth=st.floats(1.5, 12.0), margin=st.floats(0.25, 0.6),
    between=st.booleans(),
)  # fmt: skip
@settings(max_examples=25, derandomize=True)
def test_places_fill_a_room_up_to_the_margin(width, depth, margin, between):
    walls = box(-width / 2, -depth / 2, width / 2, depth / 2)
    places = space(walls).places(margin, between=between)
    half = np.array([width, depth]) / 2 - margin
    if min(half) > 0.2:
        assert len(places) > 0
    assert (np.abs(places) < half).all()
    spacing = max(0.1, np.sqrt(4 * half.prod() / 1000))
    if len(places):
        assert (half - np.abs(places).max(axis=0) < spacing + TOLERANCE).all()
    assert len(places) <= 1150


@pytest.mark.long
@given(
    st.lists(
        st.tuples(*[st.floats(-4.0, 4.0)] * 2, *[st.floats(0.1, 1.0)] * 2), min_size=1, max_size=8
    )
)
@settings(max_examples=25, derandomize=True)
def test_places_keep_their_margin_from_every_wall(boxes):
    walls = box(-5.0, -5.0, 5.0, 5.0)
    for x, y, a, b in boxes:
        walls += box(x, y, x + a, y + b)
    try:
        found = space(walls, start=(-4.5, -4.5))
    except TaskError:
        return
    places = found.places(0.3)
    assert distance_to_segments(places, walls).min(initial=np.inf) > 0.3


def test_what_cannot_be_reached_is_no_place():
    """A closed room beside the first, the inside of a pillar, and all that is outside."""
    walls = [*box(-2.0, -2.0, 2.0, 2.0), *box(2.0, -2.0, 6.0, 2.0), *box(0.8, 0.8, 1.8, 1.8)]
    places = space(walls, [(-1.0, -1.0, 0.7)]).places(0.25)
    assert (np.abs(places) < 2.0).all()
    assert not ((places > 0.8) & (places < 1.8)).all(axis=1).any()
    assert (np.hypot(*(places + 1.0).T) > 0.95).all()


@pytest.mark.parametrize(
    ("gap", "passes"), [(2 * PASSAGE + 0.15, True), (2 * PASSAGE - 0.1, False)]
)
def test_a_door_is_passed_if_the_robot_fits(gap, passes):
    walls = [*box(-2.0, -2.0, 6.0, 2.0), (2.0, -2.0, 2.0, -gap / 2), (2.0, gap / 2, 2.0, 2.0)]
    places = space(walls).places(0.3)
    assert (places[:, 0].max() > 2.0) == passes


def test_held_out_places_are_none_of_the_others():
    room = space(box(-2.0, -3.0, 2.0, 3.0))
    seen, unseen = room.places(0.3), room.places(0.3, between=True)
    apart = np.hypot(*np.moveaxis(seen[:, None] - unseen[None], 2, 0))
    assert apart.min() > 0.07
    assert min(len(seen), len(unseen)) > 500


def test_open_ground_has_places_about_the_start():
    places = space(np.zeros((0, 4)), start=(7.0, -3.0)).places(0.3)
    assert np.hypot(*(places - [7.0, -3.0]).T).max() < 3.0
    assert len(places) > 100


def test_a_start_in_a_wall_is_refused():
    with pytest.raises(TaskError, match=r"within 0\.2 m of something"):
        space(box(-2.0, -2.0, 2.0, 2.0), start=(1.9, 0.0))
