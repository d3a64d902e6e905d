"""Segments against closed forms and against each other."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.control.splines import coefficients, evaluate, wrap_offset
from gazelle.control.trajectory import TrajectoryTable, Waypoints

NUMBER = st.floats(-10.0, 10.0)
DURATION = st.floats(0.1, 10.0)
NAN = math.nan


def at(poly, *times):
    values = [evaluate(np.asarray(poly), np.array(t), np.array(True)) for t in times]
    return [tuple(float(each) for each in value) for value in values]


def segment(duration, start, end):
    return coefficients(np.array(duration), *(tuple(map(np.array, s)) for s in (start, end)))


@pytest.mark.parametrize(
    ("start", "end", "wanted"),
    [
        # Known polynomials: the line, the smooth step 3 s² - 2 s³ and the minimum jerk step.
        ((1, NAN, NAN), (3, NAN, NAN), [1, 1, 0, 0, 0, 0]),
        ((1, 5, 2), (3, NAN, NAN), [1, 1, 0, 0, 0, 0]),
        ((0, 0, NAN), (1, 0, NAN), [0, 0, 3 / 4, -2 / 8, 0, 0]),
        ((0, 0, 9), (1, 0, NAN), [0, 0, 3 / 4, -2 / 8, 0, 0]),
        ((0, 0, 0), (1, 0, 0), [0, 0, 0, 10 / 8, -15 / 16, 6 / 32]),
        ((0, 1, 2), (2 + 4, 1 + 4, 2), [0, 1, 1, 0, 0, 0]),  # t + t²
        ((0, 0, 0), (32, 80, 160), [0, 0, 0, 0, 0, 1]),  # t⁵
    ],
)
def test_segments_of_two_seconds_are_the_polynomials_that_they_must_be(start, end, wanted):
    assert segment(2.0, start, end).tolist() == pytest.approx(wanted, abs=1e-12)


def test_a_segment_without_duration_holds_its_start():
    assert segment(0.0, (1, 2, 3), (4, 5, 6)).tolist() == [1, 0, 0, 0, 0, 0]


@given(DURATION, *[NUMBER] * 6)
def test_a_quintic_meets_position_velocity_and_acceleration(t, p0, v0, a0, p1, v1, a1):
    first, last = at(segment(t, (p0, v0, a0), (p1, v1, a1)), 0.0, t)
    assert first == pytest.approx((p0, v0, a0), abs=1e-9)
    size = 1e-9 * (1.0 + t**5) / min(t, 1.0) ** 5
    assert last == pytest.approx((p1, v1, a1), abs=size, rel=1e-6)


@given(DURATION, *[NUMBER] * 4)
def test_a_cubic_meets_position_and_velocity(t, p0, v0, p1, v1):
    poly = segment(t, (p0, v0, NAN), (p1, v1, 7.0))
    assert poly[4] == poly[5] == 0.0
    first, last = at(poly, 0.0, t)
    assert first[:2] == pytest.approx((p0, v0), abs=1e-9)
    assert last[:2] == pytest.approx((p1, v1), abs=1e-6, rel=1e-6)


@given(DURATION, NUMBER, NUMBER, st.floats(0.0, 1.0))
def test_a_line_has_one_speed(t, p0, p1, share):
    (found,) = at(segment(t, (p0, NAN, NAN), (p1, NAN, NAN)), share * t)
    assert found == pytest.approx((p0 + share * (p1 - p0), (p1 - p0) / t, 0.0), abs=1e-9)


@given(DURATION, *[NUMBER] * 6, st.floats(0.0, 1.0))
def test_rates_are_the_derivatives(t, p0, v0, a0, p1, v1, a1, share):
    poly, h = segment(t, (p0, v0, a0), (p1, v1, a1)), 1e-6 * t
    low, now, high = at(poly, share * t - h, share * t, share * t + h)
    for order in (0, 1):
        slope = (high[order] - low[order]) / (2 * h)
        assert now[order + 1] == pytest.approx(slope, rel=1e-3, abs=1e-2 / min(t, 1.0) ** 3)


@pytest.mark.parametrize(
    ("before", "after", "offset"),
    [
        (0.0, 1.0, 0.0),
        (3.0, -3.0, 2 * math.pi),
        (10.0, 0.0, 4 * math.pi),
        (-10.0, 0.0, -4 * math.pi),
        (0.0, math.pi, 0.0),
        (0.0, -math.pi, 0.0),
        (0.0, 3 * math.pi, -2 * math.pi),
    ],
)
def test_offsets_lead_the_shorter_way(before, after, offset):
    found = wrap_offset(np.array(before), np.array(after))
    assert float(found) == pytest.approx(offset)


def table(*, endless=False, nworld=1, joints=1):
    made = TrajectoryTable(nworld, joints, np.full(joints, endless))
    made.hold(0.0, np.zeros((nworld, joints)), np.arange(nworld))
    return made


def points(times, positions, velocities=None, joints=(0,)):
    rows = np.array(positions, float).reshape(len(times), len(joints))
    speeds = np.full(rows.shape, NAN) if velocities is None else np.reshape(velocities, rows.shape)
    nothing = np.full(rows.shape, NAN)
    return Waypoints(np.array(times, float), rows, speeds, nothing, np.array(joints))


def positions(of, time):
    return of.sample(time).position.tolist()


def test_a_trajectory_bridges_from_where_it_is_and_holds_its_end():
    t = table()
    t.follow(points([1.0, 2.0], [1.0, 3.0]), 0.0, 0.0, 7, np.array([0]))
    assert [positions(t, x)[0][0] for x in (-1.0, 0.0, 0.5, 1.0, 1.5, 2.0, 9.0)] == pytest.approx(
        [0, 0, 0.5, 1, 2, 3, 3]
    )
    after = t.sample(9.0)
    assert (after.velocity[0, 0], after.goal[0, 0], after.last[0, 0]) == (0.0, 7, True)
    assert t.sample(1.5).last[0, 0]
    assert not t.sample(0.5).last[0, 0]


def test_another_takes_over_at_its_time_and_not_before():
    t = table()
    t.follow(points([1.0, 2.0], [1.0, 2.0]), 0.0, 0.0, 1, np.array([0]))
    t.follow(points([2.5, 3.0], [0.5, 0.0]), 0.5, 1.5, 2, np.array([0]))
    found = [positions(t, x)[0][0] for x in (0.5, 1.0, 1.5, 2.0, 2.5, 3.0)]
    assert found == pytest.approx([0.5, 1.0, 1.5, 1.0, 0.5, 0.0])
    assert [int(t.sample(x).goal[0, 0]) for x in (1.4, 1.6, 4.0)] == [1, 2, 2]


def test_joints_and_worlds_that_are_not_named_go_on():
    t = table(nworld=3, joints=2)
    rows = np.arange(3)
    t.follow(points([1.0, 4.0], [[1, 1], [4, 4]], joints=(0, 1)), 0.0, 0.0, 1, rows)
    t.follow(points([3.0], [0.0], joints=(1,)), 2.0, 2.0, 2, np.array([1]))
    assert positions(t, 3.0) == [[3.0, 3.0], [3.0, 0.0], [3.0, 3.0]]
    assert positions(t, 4.0) == [[4.0, 4.0], [4.0, 0.0], [4.0, 4.0]]
    assert t.sample(4.0).last.all()
    t.hold(4.0, np.full((1, 2), 9.0), np.array([2]))
    assert positions(t, 5.0) == [[4.0, 4.0], [4.0, 0.0], [9.0, 9.0]]
    assert positions(t, 3.5)[0] == [3.5, 3.5]


def test_endless_joints_take_the_shorter_way():
    for endless, end in ((True, 3.5), (False, 3.5 - 2 * math.pi)):
        t = table(endless=endless)
        t.hold(0.0, np.array([[3.0]]), np.array([0]))
        t.follow(points([1.0], [3.5 - 2 * math.pi]), 0.0, 0.0, 0, np.array([0]))
        assert positions(t, 2.0)[0][0] == pytest.approx(end)


def test_a_ramp_ends_at_rest_and_begins_with_the_speed():
    t = table()
    t.follow(points([1.0, 2.0], [1.0, 2.0], [1.0, 1.0]), 0.0, 0.0, 0, np.array([0]))
    t.ramp(1.5, 0.4, np.array([0]))
    begin, end = t.sample(1.5), t.sample(1.9)
    assert begin.position[0, 0] == pytest.approx(1.5)
    assert begin.velocity[0, 0] == pytest.approx(1.0)
    assert end.velocity[0, 0] == pytest.approx(0.0, abs=1e-9)
    assert 1.5 < end.position[0, 0] < 1.9
    assert positions(t, 5.0) == end.position.tolist()


@pytest.mark.long
@given(
    st.lists(
        st.tuples(
            st.floats(0.0, 3.0), st.floats(0.1, 3.0), st.lists(NUMBER, min_size=1, max_size=4)
        ),
        min_size=1,
        max_size=5,
    ),
    st.integers(0, 2),
)
def test_worlds_are_as_if_alone_whatever_takes_over(given_, world):
    """Positions never jump either: each begins where the one before is."""
    batch, alone = table(nworld=3), table()
    for number, (begin, gap, values) in enumerate(given_, 1):
        times = begin + gap * np.arange(1, len(values) + 1)
        batch.follow(points(times, values), 0.0, begin, number, np.array([number % 3]))
        if number % 3 == world:
            alone.follow(points(times, values), 0.0, begin, number, np.array([0]))
    for time in np.linspace(0.0, 20.0, 41):
        one, many = alone.sample(time), batch.sample(time)
        assert many.position[world] == pytest.approx(one.position[0])
        assert many.velocity[world] == pytest.approx(one.velocity[0])
        near = alone.sample(time + 1e-9)
        assert abs(near.position - one.position).max() < 1e-3
