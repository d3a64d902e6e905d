from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import binomtest

from gazelle.training.statistics import EpisodeLog, Rate, wilson_interval
from gazelle.training.stepper import Episodes


@given(st.integers(1, 500).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n))))
def test_wilson_interval_agrees_with_scipy(case):
    count, total = case
    expected = binomtest(count, total).proportion_ci(method="wilson")
    assert wilson_interval(count, total) == pytest.approx((expected.low, expected.high), abs=1e-12)


def test_nothing_counted_means_nothing_known():
    assert wilson_interval(0, 0) == (0.0, 1.0)
    assert Rate(0, 0).value == 0.0


def episodes(returns, goals=None, **outcomes):
    count = len(returns)
    reached = outcomes.get("is_success", [False] * count)
    return Episodes(
        np.arange(count),
        np.array(returns, dtype=float),
        np.full(count, 7),
        {name: np.array(values) for name, values in outcomes.items()},
        np.array(reached if goals is None else goals).astype(np.int64),
    )


def test_log_looks_back_on_its_window_only():
    log = EpisodeLog(window=3)
    for value in range(10):
        log.add(episodes([value], is_success=[value % 2 == 0]))
    assert log.summary() == {"return": 8.0, "length": 7.0, "success_rate": pytest.approx(1 / 3)}
    assert log.total == 10


def test_log_continues_from_its_state():
    log, other = EpisodeLog(), EpisodeLog()
    log.add(episodes([1.0, 2.0], is_collision=[True, False]))
    other.set_state(log.get_state())
    assert other.summary() == log.summary()


def test_log_without_episodes_has_nothing_to_say():
    assert EpisodeLog().summary() == {}


def test_success_is_the_share_of_goals_where_episodes_go_on_to_the_next():
    log = EpisodeLog()
    log.add(
        episodes(
            [1.0, 2.0, 3.0, 4.0],
            goals=[0, 4, 3, 2],
            is_success=[False, False, True, False],
            is_timeout=[True, False, False, True],
        )
    )
    assert log.summary()["success_rate"] == pytest.approx(9 / 11)
