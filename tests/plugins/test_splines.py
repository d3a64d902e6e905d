"""Paths through poses."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from gazelle.errors import SimulationError
from gazelle.plugins.splines import PoseSpline

TIMES = np.array([0.0, 1.0, 3.0, 4.0])
POINTS = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 1.0], [2.0, 2.0, 0.0], [0.0, 2.0, -1.0]])
TURNS = Rotation.from_euler("xyz", [[0, 0, 0], [0.2, 0, 0.7], [0, 0.3, 1.5], [0, 0, 2.2]])
UPRIGHT = np.tile([0.0, 0.0, 0.0, 1.0], (4, 1))


def hermite(p, q, m, n, t):
    """Return a cubic by its four basis functions."""
    one, two = 2 * t**3 - 3 * t**2 + 1, -2 * t**3 + 3 * t**2
    return one * p + (t**3 - 2 * t**2 + t) * m + two * q + (t**3 - t**2) * n


@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_positions_are_on_a_cardinal_spline(t, tension):
    path = PoseSpline(TIMES, POINTS, UPRIGHT, tension)
    half = 0.5 * (1.0 - tension)
    tangents = half * np.array(
        [POINTS[1] - POINTS[0], POINTS[2] - POINTS[0], POINTS[3] - POINTS[1], POINTS[3] - POINTS[2]]
    )
    for leg in range(3):
        moment = TIMES[leg] + t * (TIMES[leg + 1] - TIMES[leg])
        expected = hermite(*POINTS[leg : leg + 2], *tangents[leg : leg + 2], t)
        np.testing.assert_allclose(path.at(np.array([moment]))[0][0], expected, atol=1e-9)


def slerp(p, q, t):
    return p * Rotation.from_rotvec(t * (p.inv() * q).as_rotvec())


@pytest.mark.long
@given(st.floats(0.01, 0.99))
def test_orientations_are_on_shoemakes_spline(t):
    path = PoseSpline(TIMES, POINTS, TURNS.as_quat())

    def control(i):
        ends = TURNS[max(i - 1, 0)], TURNS[min(i + 1, 3)]
        bend = sum((TURNS[i].inv() * end).as_rotvec() for end in ends)
        return TURNS[i] * Rotation.from_rotvec(-0.25 * bend)

    for leg in range(3):
        outer = slerp(TURNS[leg], TURNS[leg + 1], t)
        inner = slerp(control(leg), control(leg + 1), t)
        expected = slerp(outer, inner, 2.0 * t * (1.0 - t))
        moment = TIMES[leg] + t * (TIMES[leg + 1] - TIMES[leg])
        found = Rotation.from_quat(path.at(np.array([moment]))[1][0])
        # What is nearly alike is mixed evenly, which is a little beside the great circle.
        assert (expected.inv() * found).magnitude() < 2e-5


def test_a_closed_path_goes_through_its_start_smoothly():
    points = POINTS[[0, 1, 2, 0]]
    path = PoseSpline(TIMES, points, UPRIGHT)
    step = 1e-6
    ends = path.at(np.array([0.0, step, 4.0 - step, 4.0]))[0]
    np.testing.assert_allclose(ends[1] - ends[0], ends[3] - ends[2], atol=1e-10)
    np.testing.assert_allclose((ends[1] - ends[0]) / step, (points[1] - points[2]) / 2, atol=1e-4)


def test_it_waits_at_its_ends_and_one_pose_is_enough():
    path = PoseSpline(TIMES + 1.0, POINTS, UPRIGHT)
    np.testing.assert_array_equal(path.at(np.array([0.0, 9.0]))[0], POINTS[[0, 3]])
    assert path.duration == 5.0
    one = PoseSpline(np.array([2.0]), POINTS[1:2], UPRIGHT[:1])
    np.testing.assert_array_equal(one.at(np.array([0.0, 2.0, 3.0]))[0], POINTS[[1, 1, 1]])
    with pytest.raises(SimulationError, match="must increase"):
        PoseSpline(TIMES[::-1], POINTS, UPRIGHT)
