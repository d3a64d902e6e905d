"""Readings of a lidar from true ranges, against the same in NumPy."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.sensors.lidar_ranges import LidarNoise, RangeLaw, infinite_from, measure
from gazelle.streams import Stream

TRUE = st.one_of(st.floats(0.0, 9.0), st.just(np.inf), st.just(-np.inf))


@given(
    st.lists(TRUE, min_size=1, max_size=30),
    st.sampled_from([0.0, 0.01]),
    st.sampled_from([0.0, 0.05]),
    st.sampled_from([0.0, 0.3]),
    st.booleans(),
)
def test_a_report_is_noise_rounding_and_limits(ranges, precision, quantum, deviation, biased):
    true = np.array([ranges, ranges])
    stream, same = Stream(3, "lidar", 2), Stream(3, "lidar", 2)
    bias = np.full(true.shape, 0.02)[: 2 if biased else 0]
    law = RangeLaw(0.1, 5.0, quantum, 0.01, precision)
    measured, spread = np.empty((2, len(ranges) + len(ranges) % 2)), np.array([deviation, 0.0])
    measure(law, LidarNoise(spread, stream.keys, stream.counters, bias), true, 0.5, measured)
    measured = measured[:, : len(ranges)]

    wanted = true + 0.5 + 0.01 + (0.02 if biased else 0.0)
    if deviation:
        wanted[0] += deviation * same.normal(len(ranges), np.array([0]))[0]
    for step in (precision, quantum):
        wanted = np.round(wanted / step) * step if step else wanted
    wanted = np.clip(wanted, 0.1, 5.0)
    wanted[true + 0.5 >= 5.0] = np.inf
    wanted[true == -np.inf] = -np.inf
    np.testing.assert_allclose(measured, wanted, atol=1e-9)
    np.testing.assert_array_equal(stream.counters, same.counters)


@pytest.mark.parametrize("size", [1, 2, 3, 24, 25, 359])
@pytest.mark.parametrize("worlds", [None, np.array([3, 0])])
def test_normal_numbers_are_those_of_box_and_muller(size, worlds):
    stream, same = Stream(5, "noise", 7), Stream(5, "noise", 7)
    drawn = stream.normal(size, worlds)
    pairs = (size + 1) // 2
    uniform = same.uniform(2 * pairs, worlds)
    radius = np.sqrt(-2.0 * np.log1p(-uniform[:, :pairs]))
    angle = 2.0 * np.pi * uniform[:, pairs:]
    wanted = np.hstack((radius * np.cos(angle), radius * np.sin(angle)))[:, :size]
    np.testing.assert_allclose(drawn, wanted, atol=1e-12)
    np.testing.assert_array_equal(stream.counters, same.counters)


@pytest.mark.parametrize("places", [1, slice(1, 3), [2, 0], slice(None)])
def test_ranges_that_reach_as_far_as_the_sensor_are_infinite(places):
    seen = np.random.default_rng(0).uniform(0.0, 6.0, (2, 3, 7)).clip(max=5.0)
    seen[0, :, 0], seen[1, :, 1], seen[1, :, 2] = np.nan, -np.inf, np.nextafter(5.0, 0.0)
    ranges = seen[:, places]
    before, found = ranges.copy(), infinite_from(5.0, ranges)
    assert found.tobytes() == np.where(ranges < 5.0, ranges, np.inf).tobytes()
    assert found.shape == ranges.shape
    found[:] = 0.0
    np.testing.assert_array_equal(ranges, before)
