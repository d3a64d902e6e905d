"""Intervals for the rate of one more seed."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import t as student

from gazelle.training.prediction import predicted_range
from gazelle.training.statistics import SuccessRate, student_quantile

RATES = st.integers(1, 2000).flatmap(
    lambda total: st.lists(
        st.builds(SuccessRate, st.integers(0, total), st.just(total)), min_size=2, max_size=12
    )
)


@pytest.mark.parametrize("freedom", [1, 2, 3, 4, 5, 9, 30])
def test_quantiles_agree_with_scipy(freedom):
    assert student_quantile(freedom) == pytest.approx(student.ppf(0.975, freedom), rel=0.01)


def shares(rng, mean, deviation, shape):
    """Return true rates of seeds: equal, or from a beta distribution."""
    if deviation == 0.0:
        return np.full(shape, mean)
    size = mean * (1 - mean) / deviation**2 - 1
    return rng.beta(mean * size, (1 - mean) * size, shape)


@pytest.mark.parametrize("seeds", [3, 5, 10])
@pytest.mark.parametrize(
    ("mean", "deviation", "most"),
    [
        (0.5, 0.0, 0.995),
        (0.98, 0.0, 0.995),
        (0.999, 0.0, 1.0),
        (0.8, 0.1, 0.965),
        (0.95, 0.03, 0.965),
        (0.6, 0.2, 0.965),
    ],
)
def test_95_of_100_new_seeds_lie_within(seeds, mean, deviation, most):
    """Coverage is 95 % where seeds differ, and 97 to 99 % where they do not, which no sample can show."""
    rng = np.random.default_rng(3)
    episodes, draws = 1000, 2000
    counts = rng.binomial(episodes, shares(rng, mean, deviation, (draws, seeds + 1)))
    held = 0
    for row in counts.tolist():
        low, high = predicted_range([SuccessRate(count, episodes) for count in row[:-1]])
        held += low <= row[-1] / episodes <= high
    assert 0.935 <= held / draws <= most


@pytest.mark.parametrize("deviation", [0.0, 0.05])
def test_an_evaluation_of_fewer_episodes_has_a_wider_interval_that_holds(deviation):
    rng = np.random.default_rng(4)
    many, few, draws = 1000, 100, 2000
    true = shares(rng, 0.9, deviation, (draws, 5))
    counts = rng.binomial(many, true[:, :4])
    new = rng.binomial(few, true[:, 4])
    held = 0
    for row, count in zip(counts.tolist(), new.tolist(), strict=True):
        low, high = predicted_range([SuccessRate(each, many) for each in row], few)
        held += low <= count / few <= high
    assert held / draws >= 0.935


@given(RATES)
def test_intervals_hold_the_mean_and_stay_within_0_and_1(rates):
    low, high = predicted_range(rates)
    angles = [np.arcsin(np.sqrt((r.count + 0.375) / (r.total + 0.75))) for r in rates]
    centre = np.sin(np.mean(angles)) ** 2
    assert 0.0 <= low <= high <= 1.0
    assert low - 0.5 / rates[0].total <= centre <= high + 0.5 / rates[0].total


@given(RATES)
def test_intervals_of_successes_and_of_failures_mirror_each_other(rates):
    low, high = predicted_range(rates)
    failures = [SuccessRate(rate.total - rate.count, rate.total) for rate in rates]
    assert predicted_range(failures) == pytest.approx((1.0 - high, 1.0 - low), abs=1e-9)


@given(st.integers(0, 500), st.integers(1, 500))
def test_seeds_that_agree_say_as_much_as_if_seeds_made_no_difference(count, more):
    total = count + more
    low, high = predicted_range([SuccessRate(count, total)] * 3)
    wide = predicted_range([SuccessRate(count, total, total / 2)] * 3)
    assert wide[0] <= low < high <= wide[1]


def test_one_seed_shows_nothing_of_others():
    assert predicted_range([SuccessRate(9, 10)]) is None
    assert predicted_range([]) is None


def test_seeds_that_differ_widen_the_interval():
    """Two seeds of 95 and 73 % once stood as '83.8 %, 80.7 to 86.6'."""
    low, high = predicted_range([SuccessRate(284, 300), SuccessRate(219, 300)])
    assert low < 0.73
    assert high > 0.95
