"""Distance and heading of a goal, against complex numbers."""

import cmath
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.envs.polar import distance_to, heading_to

place = st.tuples(st.floats(-10, 10), st.floats(-10, 10))
angle = st.floats(-math.pi, math.pi)


@given(place, place, angle)
def test_seen_from_the_robot(robot, goal, yaw):
    position = np.array([[*robot, 0.3]])
    distance = distance_to(position, np.array([goal]))[0]
    heading = heading_to(position, np.array([yaw]), np.array([goal]))[0]
    offset = complex(*goal) - complex(*robot)
    assert distance == pytest.approx(abs(offset))
    assert -math.pi <= heading <= math.pi
    if abs(offset) > 1e-6:
        assert cmath.rect(1, heading + yaw) == pytest.approx(offset / abs(offset), abs=1e-6)


def test_left_is_positive():
    at, goal = np.zeros((1, 3)), np.array([[0.0, 1.0]])
    assert heading_to(at, np.zeros(1), goal)[0] == pytest.approx(math.pi / 2)
