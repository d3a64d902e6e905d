from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import binomtest

from gazelle.training.episodes import Episodes
from gazelle.training.statistics import (
    EpisodeLog,
    SuccessRate,
    clustered_rate,
    rate_between_worlds,
    wilson_interval,
)


@given(st.integers(1, 500).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n))))
def test_wilson_interval_agrees_with_scipy(case):
    count, total = case
    expected = binomtest(count, total).proportion_ci(method="wilson")
    assert wilson_interval(count, total) == pytest.approx((expected.low, expected.high), abs=1e-12)


def test_nothing_counted_means_nothing_known():
    assert wilson_interval(0, 0) == (0.0, 1.0)
    assert SuccessRate(0, 0).value == 0.0


def episodes(returns, goals=None, since=3, **outcomes):
    count = len(returns)
    told = {name: np.array(values) for name, values in outcomes.items()}
    reached = outcomes.get("is_success", [False] * count)
    return Episodes(
        slots=np.arange(count),
        returns=np.array(returns, dtype=float),
        lengths=np.full(count, 7),
        outcomes=told,
        goals=np.array(reached if goals is None else goals).astype(np.int64),
        since_goal=np.full(count, since),
        truncated=told.get("is_timeout", np.zeros(count, dtype=bool)),
    )


@given(st.lists(st.tuples(st.integers(0, 20), st.sampled_from("sctou"), st.booleans()), min_size=1))
def test_shares_of_attempts_add_up(ways):
    """Whatever mix of ends there is, an attempt ends in exactly one of four ways."""
    found = episodes(
        [0.0] * len(ways),
        goals=[goals + (end == "s") for goals, end, _ in ways],
        since=3,
        is_success=[end == "s" for _, end, _ in ways],
        is_collision=[end == "c" for _, end, _ in ways],
        is_timeout=[end in "tu" or (late and end == "s") for _, end, late in ways],
    )
    ends = found.goals + found.collisions + found.timeouts + found.others
    np.testing.assert_array_equal(ends, found.attempts)
    np.testing.assert_array_equal(found.collisions, [end == "c" for _, end, _ in ways])
    np.testing.assert_array_equal(found.others, [end == "o" for _, end, _ in ways])
    np.testing.assert_array_equal(
        found.timeouts, [end in "tu" and goals == 0 for goals, end, _ in ways]
    )


def test_a_robot_that_stopped_going_to_goals_has_failed():
    """Cut off on the way after 3 of 7 steps is nobody's fault, after 5 of 7 it is."""
    given = {"goals": [4], "is_success": [False], "is_timeout": [True]}
    assert episodes([0.0], since=3, **given).attempts.tolist() == [4]
    assert episodes([0.0], since=5, **given).attempts.tolist() == [5]
    assert episodes([0.0], since=5, **given).timeouts.tolist() == [True]


@pytest.mark.parametrize("halls", [3, 10, 40])
@pytest.mark.parametrize(("share", "alike"), [(0.6, 0.0), (0.9, 0.02), (0.9, 0.1), (0.6, 0.5)])
def test_intervals_of_robots_that_share_halls_hold_the_truth(halls, share, alike):
    """Each hall has a share of its own, from a beta distribution whose intra-class correlation is known.

    Of few halls, or where few fare ill, 95 % intervals hold 91 to 92 %.
    """
    rng = np.random.default_rng(7)
    robots, inside, widths = 30, [], []
    for _ in range(300):
        each = np.full(halls, share)
        if alike:
            scale = 1.0 / alike - 1.0
            each = rng.beta(share * scale, (1.0 - share) * scale, halls)
        counts = rng.binomial(1, np.repeat(each, robots))
        worlds = np.repeat(np.arange(halls), robots)
        low, high = rate_between_worlds(counts, np.ones_like(counts), worlds).interval
        inside.append(low < share < high)
        widths.append(high - low)
    assert np.mean(inside) > 0.9
    spread = np.sqrt(share * (1 - share) / (halls * robots) * (1 + (robots - 1) * alike))
    if halls >= 10:
        assert np.mean(widths) < 1.5 * 2 * 1.96 * spread


def test_halls_that_do_not_differ_count_as_repetitions():
    worlds = np.repeat(np.arange(4), 30)
    ones = np.ones(120, np.int64)
    assert rate_between_worlds(ones, ones, worlds) == clustered_rate(ones, ones, worlds)


@pytest.mark.parametrize("hits", [0, 1, 7, 13])
def test_repetitions_that_end_alike_tell_nothing_more(hits):
    clusters = np.tile(np.arange(13), 77)
    counts = (clusters < hits).astype(np.int64)
    found = clustered_rate(counts, np.ones_like(counts), clusters)
    assert (found.count, found.total) == (77 * hits, 77 * 13)
    assert found.interval == pytest.approx(wilson_interval(hits, 13))


@given(st.lists(st.booleans(), min_size=1, max_size=60))
def test_distinct_episodes_have_wilsons_interval(ends):
    counts = np.array(ends, dtype=np.int64)
    found = clustered_rate(counts, np.ones_like(counts), np.arange(len(ends)))
    assert found.interval == wilson_interval(sum(ends), len(ends))


@pytest.mark.parametrize("share", [0.5, 0.9, 0.98])
@pytest.mark.parametrize("alike", [0.0, 0.3, 1.0])
@pytest.mark.parametrize(("episodes", "repeats"), [(13, 40), (60, 8)])
def test_intervals_hold_the_truth_where_episodes_repeat(share, alike, episodes, repeats):
    """Against known truth: each episode has a chance of its own, more or less like the others'.

    Wilson's interval over all runs, which takes repetitions for fresh draws, holds it in 20 to
    70 % of the trials where they end alike.
    """
    rng = np.random.default_rng(int(1000 * share + 100 * alike) + episodes)
    held, naive, trials = 0, 0, 300
    for _ in range(trials):
        if alike == 1.0:
            chance = (rng.random(episodes) < share).astype(float)
        elif alike > 0.0:
            weight = 1.0 / alike - 1.0
            chance = rng.beta(share * weight, (1.0 - share) * weight, episodes)
        else:
            chance = np.full(episodes, share)
        # Drawn with replacement, as goals from a list are.
        _, clusters = np.unique(rng.integers(0, episodes, episodes * repeats), return_inverse=True)
        counts = (rng.random(len(clusters)) < chance[clusters]).astype(np.int64)
        low, high = clustered_rate(counts, np.ones_like(counts), clusters).interval
        held += low - 1e-12 <= share <= high + 1e-12
        low, high = SuccessRate(int(counts.sum()), len(counts)).interval
        naive += low <= share <= high
    assert held / trials >= 0.9
    assert naive / trials < 0.75 or alike == 0.0


def test_intervals_hold_the_truth_where_episodes_are_rows_of_goals():
    """Goals reached before the first collision: 95 % of attempts, episodes of any length."""
    rng = np.random.default_rng(4)
    held = 0
    for _ in range(400):
        goals = rng.geometric(0.05, 60) - 1
        collided = (goals < 30).astype(np.int64)
        goals = np.minimum(goals, 30)
        found = clustered_rate(goals, goals + collided, np.arange(60))
        low, high = found.interval
        held += low <= 0.95 <= high
    assert held / 400 > 0.91


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
