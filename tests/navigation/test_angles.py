"""Angles between -pi and pi."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.navigation.agv import wrapped as wrapped_of_agv
from gazelle.navigation.angles import wrapped, wrapped_all


@given(st.floats(-1e3, 1e3))
def test_an_angle_keeps_its_direction(angle):
    for found in (wrapped(angle), float(wrapped_all(np.array(angle)))):
        assert abs(found) <= math.pi + 1e-12
        assert math.cos(found - angle) == pytest.approx(1.0)


@given(st.floats(-math.pi, math.pi))
def test_one_between_minus_pi_and_pi_stays_to_the_last_bit(angle):
    assert wrapped(angle) == angle
    assert wrapped_all(np.array([angle]))[0] == angle


def test_ends():
    ends = np.array([-math.pi, math.pi])
    assert wrapped_all(ends).tolist() == ends.tolist()
    assert wrapped_of_agv(ends).tolist() == [math.pi, math.pi]
