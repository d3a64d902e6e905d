"""Ranges a policy can take."""

import numpy as np

from gazelle.envs.scans import clean_ranges, nearest_obstacle


def test_every_special_range_has_a_number():
    ranges = np.array([[np.inf, -np.inf, np.nan, 1.25, 9.0, 0.0]])
    cleaned = clean_ranges(ranges, nearest=0.12, farthest=3.5)
    assert cleaned.tolist() == [[3.5, 0.12, 0.0, 1.25, 3.5, 0.0]]


def test_the_scan_given_stays_as_it_was():
    ranges = np.array([[np.inf, 1.0]])
    clean_ranges(ranges, nearest=0.1, farthest=3.5)
    assert np.isinf(ranges[0, 0])


def test_nearest_is_the_first_of_equals():
    nearest, ray = nearest_obstacle(np.array([[2.0, 1.0, 1.0], [0.5, 3.0, 3.0]]))
    assert nearest.tolist() == [1.0, 0.5]
    assert ray.tolist() == [1, 0]
