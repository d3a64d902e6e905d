"""The filter against a plain Kalman filter, against itself, and against its own statistics."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import chi2

from gazelle.engines.limits import NANOSECONDS
from gazelle.errors import Error
from gazelle.navigation.estimation import (
    ControlModel,
    ExtendedPrediction,
    KalmanFilter,
    Measurement,
    StampedCommand,
    UnscentedPrediction,
)
from gazelle.navigation.estimation.kalman import PROCESS_NOISE

KINDS = [ExtendedPrediction, UnscentedPrediction]


def measured(elements, stamp, threshold=np.inf, variance=0.01):
    """Return a measurement of some elements, given as index: value, at a time [s]."""
    values, used = np.zeros(15), np.zeros(15, bool)
    values[list(elements)], used[list(elements)] = list(elements.values()), True
    return Measurement(
        "test", round(stamp * NANOSECONDS), values, variance * np.eye(15), used, threshold
    )


@pytest.mark.parametrize("kind", KINDS)
@given(st.lists(st.floats(-5, 5), min_size=6, max_size=6), st.floats(0.01, 1.0))
@settings(max_examples=30)
def test_motion_without_turns_is_that_of_a_linear_filter(kind, values, seconds):
    """Position, velocity and acceleration along x and y: F, H and the textbook's formulas."""
    body = [0, 1, 6, 7, 12, 13]
    first = np.diag([0.5, 0.4, 0.3, 0.2, 0.1, 0.1])
    covariance = 1e-12 * np.eye(15)
    covariance[np.ix_(body, body)] = first
    noise = np.zeros((15, 15))
    noise[np.ix_(body, body)] = PROCESS_NOISE[np.ix_(body, body)]
    start = np.zeros(15)
    start[body] = values
    kalman = KalmanFilter(
        kind(), process_noise=noise, initial_state=start, initial_covariance=covariance
    )
    kalman.initialised = True
    accepted = kalman.process(measured({0: 1.0, 6: -0.5}, seconds, variance=0.05))

    one, zero = np.eye(2), np.zeros((2, 2))
    step = np.block(
        [[one, seconds * one, seconds**2 / 2 * one], [zero, one, seconds * one], [zero, zero, one]]
    )
    x, p = step @ values, step @ first @ step.T + seconds * noise[np.ix_(body, body)]
    h = np.eye(6)[[0, 2]]
    gain = p @ h.T @ np.linalg.inv(h @ p @ h.T + 0.05 * np.eye(2))
    assert accepted
    estimate = kalman.estimate
    np.testing.assert_allclose(
        estimate.state[body], x + gain @ ([1.0, -0.5] - h @ x), atol=1e-6, rtol=1e-7
    )
    np.testing.assert_allclose(
        estimate.covariance[np.ix_(body, body)], p - gain @ h @ p, atol=1e-6, rtol=1e-6
    )


@given(st.lists(st.floats(-0.5, 0.5), min_size=15, max_size=15), st.floats(0.001, 0.05))
@settings(max_examples=30)
def test_both_predictions_agree_where_the_spread_is_small(values, seconds):
    state, covariance = np.array(values), 1e-6 * np.eye(15)
    extended = ExtendedPrediction().predict(state, covariance, seconds)
    unscented = UnscentedPrediction().predict(state, covariance, seconds)
    np.testing.assert_allclose(unscented[0], extended[0], atol=1e-6)
    np.testing.assert_allclose(unscented[1], extended[1], atol=1e-10)


def test_the_unscented_mean_bends_as_the_second_order_says():
    """A heading that is known to s = 0.2 rad shortens the way ahead by exp(-s^2 / 2), to second order."""
    covariance = 1e-12 * np.eye(15)
    covariance[5, 5] = 0.04
    state = np.zeros(15)
    state[6] = 1.0
    after, spread = UnscentedPrediction().predict(state, covariance, 1.0)
    assert after[0] == pytest.approx(1.0 - 0.02, abs=1e-5)
    assert spread[1, 1] == pytest.approx(0.04, abs=1e-4)


@pytest.mark.parametrize("kind", KINDS)
def test_estimates_are_consistent(kind):
    """The normalised error squared of 40 drives lies within its chi-square bounds of 99.9 %.

    The truth is drawn by the filter's own model: noise of the velocities, measurements of the
    velocities and now and then of the place and heading.
    """
    body = [0, 1, 5, 6, 11]
    noise = np.zeros((15, 15))
    noise[body, body] = [1e-4, 1e-4, 1e-4, 0.05, 0.05]
    start = np.full(15, 1e-10)
    start[body] = [0.01, 0.01, 0.01, 0.1, 0.1]
    total, steps, dt = 0.0, 60, 0.05
    for seed in range(40):
        draw = np.random.default_rng(seed)
        kalman = KalmanFilter(
            kind(), process_noise=noise, initial_state=_cruising(),
            initial_covariance=np.diag(start),
        )  # fmt: skip
        kalman.initialised = True
        truth = _cruising()
        truth[body] += draw.normal(size=5) * np.sqrt(start[body])
        mover = ExtendedPrediction()
        for step in range(1, steps + 1):
            truth, _ = mover.predict(truth, np.zeros((15, 15)), dt)
            truth[body] += draw.normal(size=5) * np.sqrt(dt * noise[body, body])
            seen = [6, 11] if step % 5 else body
            values = truth[seen] + draw.normal(size=len(seen)) * 0.1
            kalman.process(measured(dict(zip(seen, values, strict=True)), step * dt))
        error = kalman.estimate.state[body] - truth[body]
        error[2] = np.arctan2(np.sin(error[2]), np.cos(error[2]))
        total += error @ np.linalg.solve(kalman.estimate.covariance[np.ix_(body, body)], error)
    assert chi2.ppf(0.0005, 200) < total < chi2.ppf(0.9995, 200)


def _cruising():
    state = np.zeros(15)
    state[6], state[11] = 1.0, 0.5
    return state


def test_the_first_measurement_sets_what_it_measures():
    kalman = KalmanFilter(ExtendedPrediction(), initial_state=np.arange(15.0))
    assert kalman.process(measured({0: 7.0, 5: np.nan}, 3.0))
    assert kalman.estimate.state.tolist() == [7.0, *range(1, 15)]
    assert kalman.estimate.stamp == 3 * NANOSECONDS
    assert kalman.estimate.covariance[0, 0] == 0.01
    assert kalman.estimate.covariance[5, 5] == 1e-9


def test_far_and_infinite_measurements_are_rejected():
    kalman = KalmanFilter(ExtendedPrediction())
    kalman.process(measured({0: 0.0}, 1.0))
    before = kalman.estimate.state
    # The variances of estimate and measurement add to 0.02: 0.5 m is 3.5 of their deviations.
    assert not kalman.process(measured({0: 0.5}, 1.0, threshold=3.4))
    assert not kalman.process(measured({0: np.inf}, 1.0))
    assert kalman.estimate.state is before
    assert kalman.process(measured({0: 0.5}, 1.0, threshold=3.6))
    assert kalman.estimate.state[0] == pytest.approx(0.25)


def test_headings_on_both_sides_of_pi_average_to_pi():
    kalman = KalmanFilter(ExtendedPrediction())
    kalman.process(measured({5: np.pi - 0.1}, 1.0))
    kalman.process(measured({5: -np.pi + 0.1}, 1.0))
    assert abs(kalman.estimate.state[5]) == pytest.approx(np.pi)


def test_an_old_measurement_corrects_without_a_prediction():
    kalman = KalmanFilter(ExtendedPrediction())
    kalman.process(measured({0: 0.0, 6: 1.0}, 5.0))
    kalman.process(measured({0: 1.0}, 4.0))
    assert kalman.estimate.stamp == 5 * NANOSECONDS
    assert kalman.estimate.state[0] == pytest.approx(0.5)


def test_dynamic_noise_stops_growing_at_rest():
    def grown(speed):
        kalman = KalmanFilter(ExtendedPrediction(), dynamic_noise=True)
        kalman.process(measured({6: speed}, 0.0, variance=1e-9))
        kalman.predict(NANOSECONDS // 1000)
        return kalman.estimate.covariance[1, 1]

    assert grown(0.0) == pytest.approx(1e-9, rel=0.1)
    assert grown(2.0) == pytest.approx(4 * 0.05 * 1e-3, rel=0.01)


def test_commands_accelerate_within_limits_and_brake_when_late():
    used = np.array([True, False, False, False, False, True])
    model = ControlModel(used, timeout=0.5, acceleration_limits=np.full(6, 0.4))
    kalman = KalmanFilter(ExtendedPrediction(), control=model)
    kalman.process(measured({6: 1.0, 11: 0.0}, 10.0))
    kalman.command(StampedCommand(np.array([2.0, 3.0, 0, 0, 0, 0.2]), 10 * NANOSECONDS))
    kalman.predict(10 * NANOSECONDS + NANOSECONDS // 10)
    state = kalman.estimate.state
    assert state[6] == pytest.approx(1.04)  # 0.1 s at the limit
    assert state[11] == pytest.approx(0.02)  # 0.1 s of gain 1 times what is missing
    kalman.predict(11 * NANOSECONDS)  # the command is late: it brakes at the usual limit of 1
    assert kalman.estimate.state[12] == pytest.approx(-1.0)


def test_sigma_points_have_to_spread():
    with pytest.raises(Error, match="kappa greater than -15"):
        UnscentedPrediction(kappa=-15.0)
