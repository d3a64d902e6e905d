"""Motions of AGVs arrive, time out and can be cancelled, for many robots at once."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.errors import ControlError
from gazelle.navigation import BoundedPid, Limits, Motions, Outcome

STEP = 0.1


def drive(motions, poses, *, seconds=90.0, delay=0):
    """Drive robots along exact arcs until none moves; return their poses."""
    poses = np.array(poses, np.float64)
    seen = [poses.copy()] * (delay + 1)
    time = 0.0
    while time < seconds:
        command = motions.update(seen[-1 - delay], time)
        if not motions.active.any():
            assert not command.any()
            break
        turn = command[:, 1] * STEP
        middle = poses[:, 2] + turn / 2.0
        along = command[:, 0] * STEP * np.sinc(turn / (2.0 * np.pi))
        poses += np.stack((along * np.cos(middle), along * np.sin(middle), turn), axis=1)
        poses[:, 2] = np.arctan2(np.sin(poses[:, 2]), np.cos(poses[:, 2]))
        seen.append(poses.copy())
        time += STEP
    return poses


coordinates = st.floats(-20.0, 20.0)
angles = st.floats(-math.pi, math.pi)


@pytest.mark.long
@settings(deadline=None, max_examples=60)
@given(st.lists(st.tuples(coordinates, coordinates, coordinates, coordinates, angles), min_size=1))
def test_move_l_stops_at_every_point(cases):
    table = np.array(cases)
    motions = Motions(len(table))
    motions.move_l(table[:, 0], table[:, 1], timeout=300.0)
    end = drive(motions, table[:, 2:5], seconds=400.0)
    assert (motions.outcome == Outcome.REACHED).all()
    away = np.hypot(*(end[:, :2] - table[:, :2]).T)
    assert away.max() <= motions.limits.distance + 1e-9


@pytest.mark.long
@settings(deadline=None, max_examples=60)
@given(st.lists(st.tuples(angles, angles), min_size=1))
def test_move_ofsc_ends_at_the_heading(cases):
    table = np.array(cases)
    motions = Motions(len(table))
    motions.move_ofsc(table[:, 0])
    start = np.zeros((len(table), 3))
    start[:, 2] = table[:, 1]
    end = drive(motions, start)
    off = np.arctan2(np.sin(end[:, 2] - table[:, 0]), np.cos(end[:, 2] - table[:, 0]))
    assert np.abs(off).max() <= motions.limits.angle + 1e-9
    assert not end[:, :2].any()


@pytest.mark.parametrize("angle", [0.3, -2.0, 3.5, -7.0, 4.0 * math.pi])
def test_move_c_turns_by_the_whole_angle(angle):
    motions = Motions(1, Limits(angular=1.0))
    motions.move_c(angle)
    end = drive(motions, [[1.0, 2.0, 0.7]])
    assert math.isclose(math.cos(end[0, 2] - 0.7 - angle), 1.0, abs_tol=1e-4)
    assert motions.taken[0] >= abs(angle) - 0.02  # nobody turns faster than he may


def test_a_motion_tells_the_time_it_took():
    motions = Motions(1, Limits(linear=0.5, gain=100.0))
    motions.move_l(5.0, 0.0)
    drive(motions, [[0.0, 0.0, 0.0]])
    assert motions.taken[0] == pytest.approx(10.0, abs=0.11)


def test_old_poses_do_no_harm():
    motions = Motions(3)
    motions.move_l([3.0, -2.0, 0.0], [1.0, 2.0, -4.0])
    end = drive(motions, np.zeros((3, 3)), delay=1)
    assert (motions.outcome == Outcome.REACHED).all()
    assert np.hypot(*(end[:, :2] - [[3.0, 1.0], [-2.0, 2.0], [0.0, -4.0]]).T).max() < 0.06


def test_who_is_seen_at_the_goal_in_passing_has_not_arrived():
    motions = Motions(2)
    motions.move_l([1.0, 1.0], 0.0)
    motions.update([[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]], 0.0)
    command = motions.update([[0.99, 0.0, 0.0], [0.99, 0.0, 0.0]], 1.0)
    assert motions.active.all()
    assert not command.any()
    command = motions.update([[1.2, 0.0, 0.0], [0.99, 0.0, 0.0]], 1.1)
    assert motions.outcome.tolist() == [Outcome.MOVING, Outcome.REACHED]
    assert command[0, 0] < 0.0
    motions.move_ofsc(0.5, [1])
    motions.update([[1.2, 0.0, 0.0], [0.99, 0.0, 0.5]], 1.2)
    assert motions.active[1]
    motions.update([[1.2, 0.0, 0.0], [0.99, 0.0, 0.5]], 1.3)
    assert motions.outcome[1] == Outcome.REACHED


def test_a_robot_that_does_not_get_there_times_out_and_stands():
    motions = Motions(2)
    motions.move_l(5.0, 0.0, [1], timeout=2.0)
    for tick in range(25):
        command = motions.update(np.zeros((2, 3)), tick * STEP)
    assert motions.outcome.tolist() == [Outcome.IDLE, Outcome.TIMED_OUT]
    assert motions.taken[1] == pytest.approx(2.0)
    assert not command.any()


def test_a_motion_goes_on_when_time_begins_again():
    motions = Motions(1)
    motions.move_l(5.0, 0.0, timeout=3.0)
    for time in (100.0, 101.0, 0.0, 1.0):
        motions.update(np.zeros((1, 3)), time)
        assert motions.active.all()
    assert motions.taken[0] == pytest.approx(2.0)
    motions.update(np.zeros((1, 3)), 2.0)
    assert motions.outcome[0] == Outcome.TIMED_OUT


def test_a_cancelled_motion_ends_and_others_go_on():
    motions = Motions(2)
    motions.move_l(5.0, 0.0)
    motions.update(np.zeros((2, 3)), 0.0)
    motions.cancel(0)
    command = motions.update(np.zeros((2, 3)), STEP)
    assert not command[0].any()
    assert command[1, 0] > 0.0
    assert motions.outcome.tolist() == [Outcome.CANCELLED, Outcome.MOVING]


def test_nonsense_is_refused():
    motions = Motions(2)
    for bad in (
        lambda: motions.move_l(math.nan, 0.0),
        lambda: motions.move_l(0.0, 0.0, [2]),
        lambda: motions.move_c(1.0, timeout=0.0),
        lambda: motions.update(np.zeros((3, 3)), 0.0),
        lambda: Limits(linear=0.0),
        lambda: BoundedPid(1.0, integral=(1.0, -1.0)),
        lambda: BoundedPid(1.0).update(0.0, -1.0),
    ):
        with pytest.raises(ControlError):
            bad()


@given(st.lists(st.floats(-10.0, 10.0), min_size=1, max_size=50))
def test_the_integral_never_winds_up(errors):
    free = BoundedPid(1.0, 5.0, integral=(-0.5, 0.5))
    bound = BoundedPid(1.0, 5.0, integral=(-0.5, 0.5), output=(-2.0, 2.0))
    for error in errors:
        assert abs(free.update(error, 0.1)[0] - error) <= 0.5 + 1e-9
        assert abs(bound.update(error, 0.1)[0]) <= 2.0


def test_a_pid_does_what_its_letters_say():
    pid = BoundedPid(2.0, 1.0, 0.5)
    assert pid.update(1.0, 0.1)[0] == pytest.approx(2.0 + 0.1)
    assert pid.update(2.0, 0.1)[0] == pytest.approx(4.0 + 0.3 + 5.0)
    pid.reset()
    assert pid.update(1.0, 0.1)[0] == pytest.approx(2.1)
