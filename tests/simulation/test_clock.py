"""Schedules on simulated time."""

from hypothesis import given
from hypothesis import strategies as st

from gazelle.simulation import Clock, Schedule, Stopwatch


@given(rate=st.floats(0.5, 2000), step=st.sampled_from([0.001, 0.002, 0.01, 1 / 240]))
def test_a_rate_is_kept_on_the_average_or_capped_by_the_step(rate, step):
    clock, schedule = Clock(step), Schedule(rate)
    times = []
    while clock.now < 3.0:
        if schedule.is_due(clock.now_ns):
            times.append(clock.now_ns)
            schedule.done(clock.now_ns)
        clock.advance(clock.steps_to(schedule.due_ns))
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
        assert clock.steps_to(schedule.due_ns) == 1
        clock.advance(1)


@given(
    step=st.sampled_from([0.0005, 0.001, 1 / 240, 0.02]),
    start=st.integers(0, 10**18),
    laps=st.lists(st.integers(0, 10**6), min_size=1, max_size=20),
)
def test_a_stopwatch_tells_the_same_whenever_it_is_started(step, start, laps):
    early, late = Clock(step), Clock(step)
    late.now_ns = start
    watches = Stopwatch(early), Stopwatch(late)
    for steps in laps:
        early.advance(steps)
        late.advance(steps)
        assert watches[0].elapsed == watches[1].elapsed
        assert watches[0].lap() == watches[1].lap() == steps * early.step_ns / 1e9
        assert watches[1].elapsed == 0.0
