"""Marks land where the camera sees the place."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.description import Pose
from gazelle.envs.pictures import ground_points, mark_square
from gazelle.sensors import View, look_at


@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(1, 9))
def test_the_middle_of_the_picture_sees_what_is_looked_at(x, y, height):
    view = View(look_at((0.0, 0.5, height), (x, y + 1e-6, 0.0)), width=41, height=31)
    assert ground_points(view)[15, 20].tolist() == pytest.approx([x, y], abs=1e-5)


def test_there_is_no_ground_above_the_horizon():
    view = View(Pose(z=1.0), width=4, height=4)
    points = ground_points(view)
    assert np.isnan(points[:2]).all()
    assert (points[2:, :, 0] > 0).all()
    assert (points[2:, 0, 1] > points[2:, 3, 1]).all()


def test_only_the_square_is_tinted():
    view = View(look_at((0.0, 0.0, 5.0), (1e-6, 0.0, 0.0)), width=100, height=100)
    black = np.zeros((100, 100, 3), dtype=np.uint8)
    marked = mark_square(black, view, (0.0, 0.0), 1.0)
    metre = 100 / (2 * 5 * np.tan(1.047 / 2))
    assert (marked[..., 0] > 0).sum() == pytest.approx(metre**2, rel=0.15)
    assert not black.any()
