"""Potentials solve the equation that they are made by, in every cell, whatever the prices are."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.navigation.planners.potential import NOT_REACHED, PotentialField


def prices_of(seed, rows, columns, closed):
    random = np.random.default_rng(seed)
    prices = random.uniform(50.0, 250.0, (rows, columns)).astype(np.float32)
    prices[random.random((rows, columns)) < closed] = 0.0
    return prices


def from_neighbours(values, prices, quadratic):
    """Return the equation's result for the neighbours of the inner cells."""
    a = np.minimum(values[1:-1, 2:], values[1:-1, :-2])
    b = np.minimum(values[2:, 1:-1], values[:-2, 1:-1])
    price = prices[1:-1, 1:-1]
    apart = np.abs(a - b)
    both = 0.5 * (a + b + np.sqrt(np.maximum(2.0 * price**2 - apart**2, 0.0)))
    return np.where((apart < price) & bool(quadratic), both, np.minimum(a, b) + price)


SIDES = st.integers(5, 40)


@settings(max_examples=60)
@given(st.integers(0, 2**32 - 1), SIDES, SIDES, st.floats(0.0, 0.6), st.integers(0, 1))
def test_every_cell_has_what_its_neighbours_make_of_it(seed, rows, columns, closed, quadratic):
    prices = prices_of(seed, rows, columns, closed)
    source = columns // 2, rows // 2
    field = PotentialField(rows, columns)
    assert field.spread(prices, source, None, 50.0, quadratic)
    values = field.values.astype(float)
    wanted = from_neighbours(values, prices, quadratic)
    inner = values[1:-1, 1:-1]
    reached = inner < NOT_REACHED
    reached[source[1] - 1, source[0] - 1] = False
    # A cell is left alone for what is less than 0.3 of its price, as its neighbours are not told.
    assert (inner[reached] >= wanted[reached] - 1e-2).all()
    assert (inner[reached] <= wanted[reached] + 0.3 * prices[1:-1, 1:-1][reached]).all()
    assert values[source[1], source[0]] == 0.0
    rim = np.concatenate((values[0], values[-1], values[:, 0], values[:, -1]))
    assert (rim == np.float32(NOT_REACHED)).all()


@given(st.integers(0, 2**32 - 1), st.floats(0.0, 0.5))
def test_all_that_is_joined_to_the_source_is_reached_and_nothing_else(seed, closed):
    prices = prices_of(seed, 20, 25, closed)
    prices[10, 12] = 50.0
    field = PotentialField(20, 25)
    field.spread(prices, (12, 10), None, 50.0)
    reached = np.zeros((20, 25), bool)
    reached[10, 12] = True
    open_ = np.zeros((20, 25), bool)
    open_[1:-1, 1:-1] = prices[1:-1, 1:-1] > 0.0
    while True:
        wider = reached.copy()
        wider[1:] |= reached[:-1]
        wider[:-1] |= reached[1:]
        wider[:, 1:] |= reached[:, :-1]
        wider[:, :-1] |= reached[:, 1:]
        wider &= open_
        if (wider == reached).all():
            break
        reached = wider
    assert ((field.values < NOT_REACHED) == reached).all()


@pytest.mark.parametrize("target", [(3, 3), (30, 3), (35, 30)])
def test_to_a_target_it_is_the_potential_of_all_cells(target):
    prices = prices_of(3, 40, 40, 0.1)
    whole, part = PotentialField(40, 40), PotentialField(40, 40)
    whole.spread(prices, (10, 10), None, 50.0)
    assert part.spread(prices, (10, 10), target, 50.0)
    assert part.values[target[1], target[0]] == whole.values[target[1], target[0]]


def test_a_field_is_used_again_without_a_trace_of_before():
    first, second = prices_of(1, 30, 30, 0.2), prices_of(2, 30, 30, 0.4)
    used, fresh = PotentialField(30, 30), PotentialField(30, 30)
    used.spread(first, (15, 15), None, 50.0)
    used.spread(second, (10, 12), None, 50.0)
    fresh.spread(second, (10, 12), None, 50.0)
    assert used.values.tobytes() == fresh.values.tobytes()
