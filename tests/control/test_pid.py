"""The PID of control_toolbox, loop by loop against its own rules written out."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.control import ControllerParameters
from gazelle.control.pid import PID_TUNABLES, Pid, PidGains, pid_changer, pid_values
from gazelle.errors import ControlError

NUMBERS = st.floats(-50.0, 50.0)
POSITIVE = st.floats(0.0, 20.0)


class Written:
    """One loop, step by step as the facts say it."""

    def __init__(self, gains):
        self.gains, self.sum, self.last = gains, 0.0, 0.0

    def compute(self, error, dt, rate=None):
        g = self.gains
        if dt == 0.0 or not math.isfinite(error):
            return 0.0
        if rate is None:
            rate, self.last = (error - self.last) / dt, error
        self.sum += dt * error
        if g.antiwindup and g.i != 0.0:
            low, high = sorted((g.i_min / g.i, g.i_max / g.i))
            self.sum = min(max(self.sum, low), high)
        term = g.i * self.sum
        if not g.antiwindup:
            term = min(max(term, g.i_min), g.i_max)
        return g.p * error + term + g.d * rate


@st.composite
def gains(draw):
    return PidGains(
        draw(NUMBERS),
        draw(NUMBERS),
        draw(NUMBERS),
        i_max=draw(POSITIVE),
        i_min=-draw(POSITIVE),
        antiwindup=draw(st.booleans()),
    )


ERRORS = st.one_of(NUMBERS, st.sampled_from([math.nan, math.inf, -math.inf]))


@given(
    st.lists(gains(), min_size=1, max_size=3),
    st.lists(
        st.tuples(st.lists(ERRORS, min_size=6, max_size=6), st.sampled_from([0.0, 0.01, 1.0]))
    ),
)
def test_every_loop_of_every_world_is_as_if_alone(some, steps):
    pid = Pid(some, nworld=2)
    alone = [[Written(each) for each in some] for _ in range(2)]
    for errors, dt in steps:
        batch = np.array(errors).reshape(2, 3)[:, : len(some)]
        got = pid.compute(batch, dt)
        for world in range(2):
            for loop in range(len(some)):
                wanted = alone[world][loop].compute(batch[world, loop], dt)
                assert got[world, loop] == pytest.approx(wanted, rel=1e-9, abs=1e-6)


@pytest.mark.parametrize(
    ("gain", "errors", "outputs"),
    [
        # Without i_clamp there is no integral term, with antiwindup neither.
        (PidGains(1.0, 1.0), [1.0, 1.0], [1.0, 1.0]),
        (PidGains(1.0, 1.0, antiwindup=True), [1.0, 1.0], [1.0, 1.0]),
        # The first step after a reset counts from an error of zero.
        (PidGains(0.0, 0.0, 1.0), [1.0, 1.0, 0.0], [1.0, 0.0, -1.0]),
        # Without antiwindup the sum grows behind the clamp, with it it does not.
        (PidGains(0.0, 2.0, 0.0, 1.0, -1.0), [-1.0, -1.0, 0.5, 2.0], [-1.0, -1.0, -1.0, 1.0]),
        (
            PidGains(0.0, 2.0, 0.0, 1.0, -1.0, antiwindup=True),
            [-1.0, -1.0, 0.5, 0.25],
            [-1.0, -1.0, 0.0, 0.5],
        ),
        # The sign of the bounds is that of the term, also for a negative gain.
        (PidGains(0.0, -2.5, 0.0, 0.2, -0.2, antiwindup=True), [-1.0, -1.0], [0.2, 0.2]),
    ],
)
def test_the_integral_is_bounded_in_two_ways(gain, errors, outputs):
    pid = Pid([gain])
    got = [pid.compute(np.array([[error]]), 1.0)[0, 0] for error in errors]
    assert got == pytest.approx(outputs)


def test_a_rate_that_is_given_is_taken():
    pid = Pid([PidGains(0.0, 0.0, 2.0)])
    assert pid.compute(np.array([[9.0]]), 0.1, np.array([[0.5]]))[0, 0] == 1.0


def test_a_reset_forgets_some_worlds():
    pid = Pid([PidGains(0.0, 1.0, 1.0, 9.0, -9.0)], nworld=2)
    pid.compute(np.ones((2, 1)), 1.0)
    kept = pid.state()
    pid.reset(np.array([1]))
    assert pid.compute(np.ones((2, 1)), 1.0).tolist() == [[2.0], [2.0]]
    pid.restore(kept)
    assert pid.compute(np.ones((2, 1)), 1.0).tolist() == [[2.0], [2.0]]


@pytest.mark.parametrize(
    ("values", "bounds"),
    [
        ({}, (0.0, 0.0)),
        ({"i_clamp": -2}, (-2.0, 2.0)),
        ({"i_clamp": 2, "i_clamp_min": 1.0}, (-1.0, 2.0)),
        ({"i_clamp_max": -3.0}, (0.0, 3.0)),
    ],
)
def test_signs_of_clamps_do_not_count(values, bounds):
    read = PidGains.read(ControllerParameters({"p": 1, **values}, "pid"))
    assert (read.i_min, read.i_max) == bounds


def test_gains_need_p_and_numbers():
    with pytest.raises(ControlError, match="no parameter 'pid/p'"):
        PidGains.read(ControllerParameters({"i": 1.0}, "pid"))
    with pytest.raises(ControlError, match="'pid/d' must be a number, not 'much'"):
        PidGains.read(ControllerParameters({"p": 1.0, "d": "much"}, "pid"))
    with pytest.raises(ControlError, match="is above the upper"):
        Pid([PidGains(i_min=1.0)])


def test_gains_are_changed_as_a_whole():
    pid = Pid([PidGains(1.0), PidGains(2.0)])
    pid_changer(pid, 1)({**pid_values(pid, 1), "p": 7.0, "antiwindup": True})
    assert pid.gains == (PidGains(1.0), PidGains(7.0, antiwindup=True))
    assert [each.name for each in PID_TUNABLES] == list(pid_values(pid))
