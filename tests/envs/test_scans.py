"""Ranges a policy can take."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from gazelle.envs.scans import clean_ranges, nearest_obstacle


def test_every_special_range_has_a_number():
    ranges = np.array([[np.inf, -np.inf, np.nan, 1.25, 9.0, 0.0]])
    cleaned = clean_ranges(ranges, nearest=0.12, farthest=3.5)
    assert cleaned.dtype == np.float32
    assert cleaned.tolist() == [[3.5, np.float32(0.12), 0.0, 1.25, 3.5, 0.0]]


@given(
    arrays(np.float64, (3, 7), elements=st.floats(width=64)),
    st.floats(0.0, 1.0),
    st.floats(1.0, 10.0),
)
def test_ranges_are_cleaned_as_numpy_would(ranges, nearest, farthest):
    with np.errstate(over="ignore"):
        wanted = np.fmax(ranges.astype(np.float32), np.float32(0.0))
    wanted[np.isneginf(ranges)] = nearest
    wanted = np.fmin(wanted, np.float32(farthest))
    # What lies between others in memory is cleaned alike.
    apart = np.zeros((3, 8))[:, :7]
    apart[:] = ranges
    for each in (ranges, apart):
        assert np.array_equal(clean_ranges(each, nearest=nearest, farthest=farthest), wanted)


def test_the_scan_given_stays_as_it_was():
    ranges = np.array([[np.inf, 1.0]])
    clean_ranges(ranges, nearest=0.1, farthest=3.5)
    assert np.isinf(ranges[0, 0])


def test_nearest_is_the_first_of_equals():
    nearest, ray = nearest_obstacle(np.array([[2.0, 1.0, 1.0], [0.5, 3.0, 3.0]]))
    assert nearest.tolist() == [1.0, 0.5]
    assert ray.tolist() == [1, 0]


@given(
    arrays(np.float32, array_shapes(min_dims=2, max_dims=2), elements=st.floats(0.0, 4.0, width=32))
)
def test_the_nearest_obstacle_is_the_first_of_the_shortest(ranges):
    nearest, ray = nearest_obstacle(ranges)
    assert np.array_equal(nearest, ranges.min(axis=1))
    assert np.array_equal(ray, ranges.argmin(axis=1))


@pytest.mark.parametrize("samples", [32, 33, 64, 65, 360])
def test_the_nearest_of_many_is_the_first_of_the_shortest(samples):
    drawn = np.random.default_rng(samples).integers(1, 40, (200, samples)).astype(np.float32)
    nearest, ray = nearest_obstacle(drawn)
    assert np.array_equal(nearest, drawn.min(axis=1))
    assert np.array_equal(ray, drawn.argmin(axis=1))
