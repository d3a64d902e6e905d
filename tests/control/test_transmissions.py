"""Transmissions: known numbers, and what always holds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.control.transmissions import (
    DifferentialTransmission,
    FourBarLinkageTransmission,
    SimpleTransmission,
)
from gazelle.errors import ControlError

RATIO = st.one_of(st.floats(0.1, 100.0), st.floats(-100.0, -0.1))
PAIR = st.tuples(RATIO, RATIO)
VALUE = st.floats(-100.0, 100.0)


def test_a_reduction_makes_slower_and_stronger():
    gear = SimpleTransmission(50.0, offset=1.0)
    assert gear.joint_effort(np.array([2.0])) == pytest.approx([100.0])
    assert gear.joint_velocity(np.array([100.0])) == pytest.approx([2.0])
    assert gear.joint_position(np.array([100.0])) == pytest.approx([3.0])
    assert gear.actuator_position(np.array([1.0])) == pytest.approx([0.0])


def test_a_differential_turns_one_joint_by_the_sum_and_one_by_the_difference():
    gear = DifferentialTransmission((10.0, 10.0), offset=(-2.0, 4.0))
    assert gear.joint_position(np.array([3.0, 5.0])) == pytest.approx([0.4 - 2.0, -0.1 + 4.0])
    assert gear.joint_effort(np.array([1.0, 0.0])) == pytest.approx([10.0, 10.0])


def test_the_second_joint_of_a_four_bar_linkage_depends_on_both():
    gear = FourBarLinkageTransmission((10.0, -10.0), (2.0, 4.0))
    assert gear.joint_velocity(np.array([20.0, 0.0])) == pytest.approx([1.0, -0.25])
    assert gear.joint_velocity(np.array([0.0, 40.0])) == pytest.approx([0.0, -1.0])
    assert gear.joint_effort(np.array([1.0, 1.0])) == pytest.approx([20.0, 4.0 * (-10.0 - 20.0)])


@pytest.mark.parametrize("kind", [DifferentialTransmission, FourBarLinkageTransmission])
@given(
    actuators=PAIR,
    joints=PAIR,
    offset=st.tuples(VALUE, VALUE),
    values=st.lists(VALUE, min_size=6, max_size=6),
)
def test_there_and_back_is_the_same(kind, actuators, joints, offset, values):
    gear = kind(actuators, joints, offset)
    some = np.reshape(values, (3, 2))
    for what in ("position", "velocity", "effort"):
        there = getattr(gear, f"joint_{what}")(some)
        assert getattr(gear, f"actuator_{what}")(there) == pytest.approx(some, rel=1e-6, abs=1e-5)


@given(RATIO, PAIR, PAIR, st.lists(VALUE, min_size=4, max_size=4))
def test_power_is_kept(reduction, actuators, joints, values):
    speeds, efforts = np.reshape(values, (2, 2))
    for gear, width in (
        (SimpleTransmission(reduction), 1),
        (DifferentialTransmission(actuators, joints), 2),
    ):
        given_, made = (
            efforts[:width] @ speeds[:width],
            gear.joint_effort(efforts[:width]) @ gear.joint_velocity(speeds[:width]),
        )
        assert made == pytest.approx(given_, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize(
    "make",
    [
        lambda: SimpleTransmission(0.0),
        lambda: DifferentialTransmission((1.0, 0.0)),
        lambda: FourBarLinkageTransmission((1.0, 1.0), (0.0, 1.0)),
        lambda: DifferentialTransmission((1.0,)),
    ],
)
def test_what_cannot_be_is_an_error(make):
    with pytest.raises(ControlError, match="reductions"):
        make()
