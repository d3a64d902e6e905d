"""Schedules on simulated time."""

from hypothesis import given
from hypothesis import strategies as st

from gazelle.simulation import Clock, Schedule


@given(rate=st.floats(0.5, 2000), step=st.sampled_from([0.001, 0.002, 0.01, 1 / 240]))
def test_a_rate_is_kept_on_the_average_or_capped_by_the_step(rate, step):
    clock, schedule = Clock(step), Schedule(rate)
    times = []
    while clock.now < 3.0:
        if schedule.is_due(clock.now_ns):
            times.append(clock.now_ns)
            schedule.done(clock.now_ns)
        clock.advance(schedule.steps_until(clock))
    expected = 3.0 * min(rate, 1.0 / step)
    assert abs(len(times) - expected) <= 2 + 1e-6 * expected


@given(rate=st.floats(0.5, 500), jump=st.integers(1, 50))
def test_nothing_is_due_before_its_time(rate, jump):
    clock, schedule = Clock(0.001), Schedule(rate)
    for _ in range(20):
        clock.advance(jump)
        if schedule.is_due(clock.now_ns):
            schedule.done(clock.now_ns)
        assert schedule.due_ns > clock.now_ns


def test_rate_zero_means_every_step():
    clock, schedule = Clock(0.01), Schedule(0.0)
    for _ in range(3):
        assert schedule.is_due(clock.now_ns)
        schedule.done(clock.now_ns)
        assert schedule.steps_until(clock) == 1
        clock.advance(1)
