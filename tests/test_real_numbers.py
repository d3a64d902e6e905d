"""Numbers that people give."""

import math

import numpy as np
import pytest

from gazelle_ros.base.real_numbers import finite, real


@pytest.mark.parametrize("value", [1, 1.5, np.float32(0.5), np.int64(-1), 10**30])
def test_numbers_are_floats(value):
    assert real(value) == float(value)
    assert isinstance(real(value), float)
    assert finite(value) == float(value)


@pytest.mark.parametrize("value", [True, "1", None, [1.0], 10**400, -(10**400), 1j, np.zeros(2)])
def test_what_is_no_number_is_none(value):
    assert real(value) is None
    assert finite(value) is None


def test_only_finite_numbers_up_to_a_limit_are_taken():
    assert math.isnan(real(math.nan))
    assert finite(math.nan) is finite(math.inf) is finite(-math.inf) is None
    assert finite(3.0, most=2.0) is finite(-3.0, most=2.0) is None
    assert finite(-2, most=2.0) == -2.0
