"""Measurements that come late, and times without any."""

from __future__ import annotations

import numpy as np
import pytest

from gazelle.engines.limits import NANOSECONDS
from gazelle.navigation.estimation import (
    ControlModel,
    ExtendedPrediction,
    KalmanFilter,
    Measurement,
    StampedCommand,
)
from gazelle.navigation.estimation.timeline import FusionTimeline


def measured(seconds, element, value, **more):
    values, used = np.zeros(15), np.zeros(15, bool)
    values[element], used[element] = value, True
    return Measurement(
        "test", round(seconds * NANOSECONDS), values, 0.01 * np.eye(15), used, **more
    )


def drive(order, *, smooth, history=10.0, **keywords):
    """Return the estimate after measurements that come one by one in an order, at 2 s."""
    kalman = KalmanFilter(ExtendedPrediction(), **keywords)
    timeline = FusionTimeline(
        kalman, sensor_timeout=NANOSECONDS, smooth=smooth, history=round(history * NANOSECONDS)
    )
    for each in order:
        timeline.add(each)
        timeline.integrate(2 * NANOSECONDS)
    return kalman.estimate


MEASUREMENTS = [
    measured(1.0, 6, 1.0), measured(1.2, 0, 0.1), measured(1.4, 6, 1.2), measured(1.4, 5, 0.3),
    measured(1.6, 11, 0.5), measured(1.8, 0, 0.9),
]  # fmt: skip


@pytest.mark.parametrize("late", range(1, 6))
def test_smoothing_makes_the_order_of_arrival_irrelevant(late):
    in_order = drive(MEASUREMENTS, smooth=True)
    others = [each for number, each in enumerate(MEASUREMENTS) if number != late]
    estimate = drive([*others, MEASUREMENTS[late]], smooth=True)
    np.testing.assert_allclose(estimate.state, in_order.state, atol=1e-12)
    np.testing.assert_allclose(estimate.covariance, in_order.covariance, atol=1e-12)
    assert estimate.stamp == in_order.stamp == round(1.8 * NANOSECONDS)
    plain = drive([*others, MEASUREMENTS[late]], smooth=False)
    assert late == 5 or not np.allclose(plain.state, in_order.state, atol=1e-6)


def test_a_measurement_older_than_the_history_is_named(caplog):
    others = MEASUREMENTS[:1] + MEASUREMENTS[2:]
    drive([*others, measured(0.5, 0, 0.1)], smooth=True, history=0.5)
    assert "history_length is too short" in caplog.text


@pytest.mark.parametrize("order", [(0, 1, 2, 3), (0, 2, 3, 1)])
def test_commands_of_the_past_are_repeated(order):
    """Full speed is wanted until 1.55 s, then rest; the second measurement may come last."""
    fast, slow = (StampedCommand(np.array([v, 0, 0, 0, 0, 0.0]), NANOSECONDS) for v in (1.0, 0.0))
    model = ControlModel(np.ones(6, bool), timeout=10.0)
    kalman = KalmanFilter(ExtendedPrediction(), control=model)
    timeline = FusionTimeline(kalman, sensor_timeout=NANOSECONDS, smooth=True, history=NANOSECONDS)
    wanted = [(1.0, fast), (1.25, fast), (1.5, fast), (1.75, slow)]
    for number in order:
        seconds, command = wanted[number]
        if number == order[-1] or number != 1:
            kalman.command(slow if number == order[-1] else command)
        timeline.add(measured(seconds, 1, 0.0, command=command))
        timeline.integrate(2 * NANOSECONDS)
    # Gain 1 for half a second in two steps of a quarter, then braking at gain 1 for a quarter.
    speed = 0.25 + 0.25 * 0.75
    assert kalman.estimate.state[6] == pytest.approx(0.75 * speed)
    assert kalman.estimate.command is slow


def test_all_wait_for_their_time():
    kalman = KalmanFilter(ExtendedPrediction())
    timeline = FusionTimeline(kalman, sensor_timeout=NANOSECONDS)
    for each in reversed(MEASUREMENTS):
        timeline.add(each)
    timeline.integrate(NANOSECONDS // 2)
    assert not kalman.initialised
    timeline.integrate(round(1.3 * NANOSECONDS))
    assert kalman.estimate.stamp == round(1.2 * NANOSECONDS)
    timeline.integrate(2 * NANOSECONDS)
    assert kalman.estimate.stamp == round(1.8 * NANOSECONDS)


@pytest.mark.parametrize(
    ("predict_to_now", "stamps"), [(False, (1.0, 1.0, 1.5)), (True, (1.1, 1.4, 1.5))]
)
def test_silence_is_predicted_over(predict_to_now, stamps):
    kalman = KalmanFilter(ExtendedPrediction())
    timeline = FusionTimeline(
        kalman, sensor_timeout=NANOSECONDS // 2, predict_to_now=predict_to_now
    )
    timeline.add(measured(1.0, 6, 2.0))
    for now, stamp in zip((1.1, 1.4, 1.5), stamps, strict=True):
        timeline.integrate(round(now * NANOSECONDS))
        assert kalman.estimate.stamp == round(stamp * NANOSECONDS)
    assert kalman.estimate.state[0] == pytest.approx(1.0)
