"""Times of paths: closed forms, limits, corners."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.errors import PlanningError
from gazelle.planning import PathLimits, parameterize
from gazelle.planning.blended_path import blended

KINDS = ["time optimal", "iterative parabolic"]


@pytest.mark.parametrize("length", [0.1, 0.5, 3.0, 40.0])
def test_one_straight_way_is_a_trapezoid(length):
    """v/a + l/v where it gets as fast as it may, 2 sqrt(l/a) where it does not."""
    v, a = 1.2, 2.5
    limits = PathLimits(np.array([v, 9.0]), np.array([a, 9.0]))
    made = parameterize(np.array([[1.0, 0.0], [1.0 + length, 0.0]]), limits)
    expected = v / a + length / v if length > v * v / a else 2.0 * np.sqrt(length / a)
    assert made.duration == pytest.approx(expected, rel=1e-3)
    np.testing.assert_allclose(made.positions[-1], [1.0 + length, 0.0], atol=1e-9)


@pytest.mark.parametrize("kind", KINDS)
@given(seed=st.integers(0, 10**6), count=st.integers(2, 9), joints=st.integers(1, 8))
def test_limits_are_kept(kind, seed, count, joints):
    random = np.random.default_rng(seed)
    points = random.uniform(-2.0, 2.0, (count, joints))
    limits = PathLimits(random.uniform(0.1, 3.0, joints), random.uniform(0.1, 5.0, joints))
    made = parameterize(points, limits, kind)
    assert (np.abs(made.velocities) <= limits.velocity * (1 + 1e-9)).all()
    assert (np.abs(made.accelerations) <= limits.acceleration * (1 + 1e-9)).all()
    assert (np.diff(made.times) > 0.0).all()
    assert not made.velocities[[0, -1]].any()
    np.testing.assert_allclose(made.positions[[0, -1]], points[[0, -1]], atol=1e-9)
    # Also those of the cubics that a controller puts between the points.
    spans = np.diff(made.times)[:, None]
    rates = np.diff(made.positions, axis=0) / spans
    first, second = made.velocities[:-1], made.velocities[1:]
    for part in np.linspace(0.0, 1.0, 9):
        push = ((6 - 12 * part) * rates - (4 - 6 * part) * first - (2 - 6 * part) * second) / spans
        assert (np.abs(push) <= limits.acceleration * (1 + 1e-6)).all()
        speed = (
            6 * part * (1 - part) * rates
            + (1 - part) * (1 - 3 * part) * first
            + part * (3 * part - 2) * second
        )
        assert (np.abs(speed) <= limits.velocity * 1.05).all()


@given(seed=st.integers(0, 10**6), deviation=st.sampled_from([0.001, 0.03, 0.1]))
def test_corners_are_rounded_within_a_tolerance(seed, deviation):
    random = np.random.default_rng(seed)
    points = random.uniform(-1.0, 1.0, (5, 3))
    path = blended(points, deviation)
    places = np.linspace(0.0, path.length, 500)
    found, slopes, bends = path.at(places)
    np.testing.assert_allclose(np.linalg.norm(slopes, axis=1), 1.0, atol=1e-9)
    np.testing.assert_allclose(found[[0, -1]], points[[0, -1]], atol=1e-9)
    assert np.linalg.norm(np.diff(found, axis=0), axis=1).max() <= path.length / 499 * (1 + 1e-9)
    away = [
        np.linalg.norm(
            found
            - a
            - np.clip((found - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)[:, None] * (b - a),
            axis=1,
        )
        for a, b in pairwise(points)
    ]
    assert np.min(away, axis=0).max() <= deviation + 1e-9
    assert np.abs((slopes * bends).sum(axis=1)).max() < 1e-6


def test_the_parabolic_one_goes_through_its_points():
    points = np.random.default_rng(0).uniform(-1, 1, (6, 4))
    limits = PathLimits(np.ones(4), np.ones(4))
    np.testing.assert_array_equal(parameterize(points, limits, KINDS[1]).positions, points)


@pytest.mark.parametrize("kind", KINDS)
def test_standing_still(kind):
    limits = PathLimits(np.ones(2), np.ones(2))
    made = parameterize(np.ones((3, 2)), limits, kind)
    assert made.duration == 0.0
    assert made.positions.tolist() == [[1.0, 1.0]]


def test_going_back_the_same_way():
    limits = PathLimits(np.ones(1), np.ones(1))
    made = parameterize(np.array([[0.0], [1.0], [0.0]]), limits)
    assert made.positions.max() == pytest.approx(1.0, abs=0.02)
    assert made.duration == pytest.approx(4.0, rel=0.1)


def test_without_limits_there_are_some():
    free = PathLimits(np.full(1, np.inf), np.full(1, np.inf)).scaled(0.5, 0.25)
    assert (free.velocity.tolist(), free.acceleration.tolist()) == ([0.5], [0.25])


@pytest.mark.parametrize(
    ("points", "kind", "words"),
    [(np.zeros((0, 2)), KINDS[0], "without points"), (np.zeros((2, 2)), "spline", "no time")],
)
def test_what_cannot_be(points, kind, words):
    limits = PathLimits(np.ones(2), np.ones(2))
    with pytest.raises(PlanningError, match=words):
        parameterize(points, limits, kind)


def test_a_trajectory_of_too_many_points_is_refused():
    limits = PathLimits(np.array([1e-3]), np.array([1.0]))
    with pytest.raises(PlanningError, match=r"2.01e\+05 points, more than the limit of 100,000"):
        parameterize(np.array([[0.0], [10.0]]), limits)
