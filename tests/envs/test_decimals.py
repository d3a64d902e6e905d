"""Whole arrays round as Python rounds single numbers."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from gazelle.envs.decimals import round2, rounded


@given(st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=20))
def test_is_python_round_bit_for_bit(values):
    assert round2(values).tolist() == [round(value, 2) for value in values]


@given(st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=20), st.integers(0, 3))
def test_other_decimals_are_pythons_too(values, decimals):
    assert rounded(values, decimals).tolist() == [round(value, decimals) for value in values]


def test_other_decimals_settle_ties():
    values = np.arange(-40_000, 40_000) / 2000
    for decimals in (0, 1, 3):
        wanted = [round(value, decimals) for value in values.tolist()]
        assert rounded(values, decimals).tolist() == wanted


@given(st.integers(-100_000, 100_000))
def test_is_python_round_next_to_ties(thousandths):
    near = np.nextafter(thousandths / 1000, [-np.inf, np.inf])
    values = [thousandths / 1000, *near.tolist()]
    assert round2(values).tolist() == [round(value, 2) for value in values]


def test_settles_what_numpy_gets_wrong():
    values = np.arange(100_000) / 1000
    wrong = np.flatnonzero(np.round(values, 2) != [round(value, 2) for value in values.tolist()])
    assert len(wrong) > 0
    assert round2(values[wrong]).tolist() == [round(v, 2) for v in values[wrong].tolist()]


def test_any_shape_and_order_keeps_its_places():
    values = np.arange(24).reshape(2, 3, 4) / 8000.0
    for each in (values, values.T, values[:, ::2], values[0, 0, 0]):
        wanted = np.vectorize(lambda value: round(float(value), 2))(each)
        assert np.array_equal(round2(each), wanted)
