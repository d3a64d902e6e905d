"""Inertias of bodies that are put together from shapes."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.builders import BuildError, solid_inertial
from gazelle.description import Box, Plane, Pose, Sphere


def test_two_halves_are_one_box():
    whole = solid_inertial([(Box((1.0, 0.4, 0.2)), Pose())], 3.0)
    halves = [(Box((0.5, 0.4, 0.2)), Pose(x=x)) for x in (-0.25, 0.25)]
    both = solid_inertial(halves, 3.0)
    assert both.pose.is_close(whole.pose)
    for name in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"):
        assert getattr(both.inertia, name) == pytest.approx(getattr(whole.inertia, name))


lengths = st.floats(0.05, 2.0)
angles = st.floats(-3.0, 3.0)
poses = st.builds(Pose, angles, angles, angles, angles, angles, angles)


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.tuples(st.builds(lambda *s: Box(s), lengths, lengths, lengths), poses), min_size=1),
    st.floats(0.1, 100.0),
)
def test_an_inertia_is_possible(parts, mass):
    a, b, c = np.linalg.eigvalsh(solid_inertial(parts, mass).inertia.matrix())
    assert a > 0.0
    assert a + b >= c * (1.0 - 1e-9)


def test_what_has_no_inertia_is_refused():
    with pytest.raises(BuildError, match="a plane has no volume"):
        solid_inertial([(Plane(), Pose())], 1.0)
    with pytest.raises(BuildError, match="without shapes"):
        solid_inertial([], 1.0)
    with pytest.raises(BuildError, match="mass"):
        solid_inertial([(Sphere(1.0), Pose())], math.nan)
