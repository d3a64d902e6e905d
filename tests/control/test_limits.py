"""Commands within limits: the cases of joint_limits_interface's own tests, and what always holds."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.control.angles import distance, normalized, shortest
from gazelle.control.limits import JointLimits, limit_law
from gazelle.description import Joint, JointAxis, SafetyController
from gazelle.errors import ControlError

SOFT = SafetyController(
    k_velocity=40.0, k_position=20.0, soft_lower_limit=-0.8, soft_upper_limit=0.8
)
HARD = JointLimits(-1.0, 1.0, 2.0, effort=8.0)
BOTH = JointLimits(-1.0, 1.0, 2.0, effort=8.0, soft=SOFT)
TICK = 0.1
ONE = np.ones((1, 1))


def position(limits, wanted, *, at=0.0, dt=TICK, times=1):
    law, got = limit_law([limits]), math.nan * ONE
    for _ in range(times):
        got = law.hold_positions(wanted * ONE, at * ONE, got, dt)
    return got[0, 0]


def effort(limits, wanted, at=0.0, speed=0.0):
    return limit_law([limits]).hold_efforts(wanted * ONE, at * ONE, speed * ONE)[0, 0]


def velocity(limits, *wanted, at=0.0, speed=0.0, dt=TICK):
    law, got = limit_law([limits]), [0.0 * ONE]
    for each in wanted:
        got.append(law.hold_velocities(each * ONE, at * ONE, speed * ONE, got[-1], dt))
    return [each[0, 0] for each in got[1:]]


def test_positions_move_at_most_at_the_velocity_limit_from_the_command_before():
    assert position(HARD, 0.1) == 0.1
    assert position(HARD, 5.0) == pytest.approx(0.2)
    assert position(HARD, -5.0, times=3) == pytest.approx(-0.6)
    assert position(HARD, 5.0, at=0.9, times=3) == 1.0
    assert position(JointLimits(velocity=2.0), 5.0, times=30) == pytest.approx(5.0)


def test_soft_limits_slow_positions_down():
    # Halfway between soft limit and zero velocity: k (0.8 - 0.75) = 1 rad/s.
    assert position(BOTH, 9.0, at=0.75) == pytest.approx(0.75 + 1.0 * TICK)
    assert position(BOTH, 9.0, at=0.9) == pytest.approx(0.9 - 2.0 * TICK)  # back behind it
    assert position(BOTH, 9.0, at=0.0, dt=0.01, times=1000) == pytest.approx(0.8)
    assert position(BOTH, -9.0, at=0.0, dt=0.01, times=1000) == pytest.approx(-0.8)


@pytest.mark.parametrize(
    ("at", "speed", "wanted", "got"),
    [
        (0.0, 0.0, 4.0, 4.0),
        (0.0, 0.0, 20.0, 8.0),
        (0.0, 0.0, -20.0, -8.0),
        (1.1, 0.0, 4.0, 0.0),
        (1.1, 0.0, -4.0, -4.0),
        (-1.1, 0.0, -4.0, 0.0),
        (-1.1, 0.0, 4.0, 4.0),
        (0.0, 2.1, 4.0, 0.0),
        (0.0, 2.1, -4.0, -4.0),
        (0.0, -2.1, -4.0, 0.0),
        (1.1, 0.0, math.inf, 0.0),
    ],
)
def test_beyond_a_limit_only_efforts_that_lead_back_act(at, speed, wanted, got):
    assert effort(HARD, wanted, at, speed) == got


def test_soft_limits_bound_efforts_by_velocity():
    assert effort(BOTH, 8.0, 0.0, 0.0) == 8.0
    assert effort(BOTH, 8.0, 0.0, 2.0) == 0.0  # at the velocity limit
    assert effort(BOTH, 8.0, 0.8, 0.0) == 0.0  # at the soft limit
    assert effort(BOTH, 8.0, 0.9, 0.0) == -8.0  # pushed back
    assert effort(BOTH, -8.0, -0.9, 0.0) == 8.0
    endless = JointLimits(velocity=2.0, effort=8.0, soft=SOFT)
    assert effort(endless, 8.0, 5.0, 1.9) == pytest.approx(4.0)


def test_velocities_are_clamped_and_change_no_faster_than_they_may():
    assert velocity(HARD, 9.0, -9.0) == [2.0, -2.0]
    slow = JointLimits(velocity=2.0, acceleration=5.0)
    assert velocity(slow, 9.0, 9.0, -9.0) == pytest.approx([0.5, 1.0, 0.5])
    assert velocity(BOTH, 9.0, at=0.75) == pytest.approx([1.0])
    assert velocity(BOTH, 9.0, at=0.9) == pytest.approx([-2.0])


LIMITS = st.builds(
    JointLimits,
    st.floats(-3.0, -0.5),
    st.floats(0.5, 3.0),
    st.floats(0.1, 5.0),
    st.one_of(st.just(math.inf), st.floats(0.5, 20.0)),
    st.floats(0.0, 50.0),
    st.one_of(
        st.none(),
        st.builds(
            SafetyController,
            st.floats(0.0, 50.0),
            st.floats(0.0, 50.0),
            st.floats(-3.0, 0.0),
            st.floats(0.0, 3.0),
        ),
    ),
)
WIDE = st.floats(-1e6, 1e6)


@given(LIMITS, st.lists(WIDE, min_size=1), st.floats(-0.4, 0.4), st.floats(-5.0, 5.0))
def test_no_command_is_ever_beyond_its_limits(limits, wanted, at, speed):
    law, place, speeds = limit_law([limits]), math.nan * ONE, 0.0 * ONE
    before, step = at, limits.velocity * 0.01
    for each in wanted:
        place = law.hold_positions(each * ONE, at * ONE, place, 0.01)
        got = place[0, 0]
        assert limits.lower <= got <= limits.upper
        assert abs(got - before) <= step + 1e-12
        before = got
        assert abs(effort(limits, each, at, speed)) <= limits.effort
        speeds = law.hold_velocities(each * ONE, at * ONE, 0.0 * ONE, speeds, 0.01)
        assert abs(speeds[0, 0]) <= limits.velocity


@given(st.lists(LIMITS, min_size=1, max_size=4), st.lists(WIDE, min_size=8, max_size=8))
def test_joints_and_worlds_do_not_depend_on_each_other(limits, values):
    wanted = np.array(values).reshape(2, 4)[:, : len(limits)]
    zero = np.zeros_like(wanted)
    together = limit_law(limits).hold_efforts(wanted, zero, zero)
    moved = limit_law(limits).hold_positions(wanted, zero, zero + math.nan, TICK)
    for column, each in enumerate(limits):
        for world in range(2):
            assert together[world, column] == effort(each, wanted[world, column])
            assert moved[world, column] == position(each, wanted[world, column])


def joint(kind="revolute", **changes):
    axis = JointAxis(lower=-1.0, upper=1.0, effort=8.0, velocity=2.0)
    return Joint("j", kind, "a", "b", axes=(axis,), **changes)


def test_a_description_gives_limits():
    assert JointLimits.of_joint(joint(safety=SOFT)) == BOTH
    assert JointLimits.of_joint(joint("continuous")).upper == math.inf
    assert not JointLimits.of_joint(Joint("j", "ball", "a", "b")).any
    assert JointLimits().any is False
    assert HARD.any


@pytest.mark.parametrize(
    ("given", "wanted"),
    [
        ({}, HARD),
        ({"has_velocity_limits": False}, JointLimits(-1.0, 1.0, effort=8.0)),
        ({"has_velocity_limits": True}, HARD),  # without a value
        ({"has_velocity_limits": True, "max_velocity": 7}, JointLimits(-1.0, 1.0, 7.0, effort=8.0)),
        ({"max_velocity": 7}, HARD),  # without has_
        ({"has_position_limits": False}, JointLimits(velocity=2.0, effort=8.0)),
        ({"has_position_limits": True, "min_position": 0.0}, HARD),
        (
            {"has_position_limits": True, "min_position": 0.0, "max_position": 0.5},
            JointLimits(0.0, 0.5, 2.0, effort=8.0),
        ),
        (
            {"has_acceleration_limits": True, "max_acceleration": 3.0, "has_effort_limits": False},
            JointLimits(-1.0, 1.0, 2.0, 3.0),
        ),
    ],
)
def test_parameters_override_single_limits(given, wanted):
    assert HARD.overridden(given, "joint_limits/j") == wanted


def test_soft_limits_need_all_four_parameters():
    whole = {
        "has_soft_limits": True,
        "k_velocity": 40.0,
        "k_position": 20.0,
        "soft_lower_limit": -0.8,
        "soft_upper_limit": 0.8,
    }
    assert HARD.overridden(whole, "l", soft=True) == BOTH
    assert HARD.overridden(whole, "l") == HARD  # Gazebo's plugin does not read them
    del whole["k_velocity"]
    assert HARD.overridden(whole, "l", soft=True) == HARD
    assert BOTH.overridden({"has_soft_limits": False}, "l", soft=True) == HARD
    with pytest.raises(ControlError, match="'l/max_effort' must be a number"):
        HARD.overridden({"has_effort_limits": True, "max_effort": "much"}, "l")


@given(WIDE, WIDE)
def test_the_shortest_turn_is_at_most_half_a_turn(start, end):
    turn = shortest(np.array(start), np.array(end))
    assert abs(turn) <= math.pi + 1e-9
    assert normalized(turn - (end - start)) == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(
    ("start", "end", "lower", "upper", "turn"),
    [
        (0.0, 1.0, -2.0, 2.0, 1.0),
        (2.5, -2.5, -3.0, 3.0, -5.0),  # the short way leads through a limit
        (2.5, -2.5, -math.inf, math.inf, 2 * math.pi - 5.0),
        (0.0, 10.5 * math.pi, -2 * math.pi, 2 * math.pi, 0.5 * math.pi),
        (0.0, 10.5 * math.pi, -2 * math.pi, 0.1 * math.pi, -1.5 * math.pi),
        (0.0, 3.0, -1.0, 1.0, 3.0),  # neither way is allowed
    ],
)
def test_turns_stay_within_limits(start, end, lower, upper, turn):
    free = np.array([math.isinf(lower)])
    got = distance(
        *(np.array([each]) for each in (start, end)), free, *map(np.array, ([lower], [upper]))
    )
    assert got[0] == pytest.approx(turn)
