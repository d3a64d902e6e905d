"""Calls of kernels played one after another in native code."""

import numpy as np
import pytest

from gazelle.engines.native import Tape, fetch_add, kernel
from gazelle.engines.native.interpreter import interpreted
from gazelle.engines.planar.crew import Crew
from gazelle.errors import EngineError


@kernel
def scaled(values, factor):
    for i in range(values.shape[0]):
        values[i] = values[i] * factor


@kernel
def added(values, others):
    for i in range(values.shape[0]):
        values[i] = values[i] + others[i]


@kernel
def taken(tickets, count, seen):
    place = fetch_add(tickets, 1)
    while place < count:
        seen[place] += 1
        place = fetch_add(tickets, 1)


@pytest.mark.parametrize("how", ["compiled", "interpreted"])
def test_calls_are_made_in_order_as_often_as_wanted(how):
    calls = [scaled, added]
    if how == "interpreted":
        calls = [interpreted(each.function) for each in calls]
    values, others = np.ones(3), np.arange(3.0)
    tape = Tape()
    wanted = values.copy()
    for count in (0, 1, 3):
        tape.play([(calls[0], (values, 2.0)), (calls[1], (values, others))], count)
        for _ in range(count):
            wanted = wanted * 2.0 + others
        assert (values == wanted).all()


def test_another_play_may_have_other_calls_and_values():
    tape, values = Tape(), np.ones(2)
    tape.play([(scaled, (values, 3.0))], 2)
    assert values.tolist() == [9.0, 9.0]
    tape.play([(scaled, (values, 0.5))], 1)
    assert values.tolist() == [4.5, 4.5]
    other = np.full(4, 1.0)
    tape.play([(added, (values, np.ones(2))), (scaled, (other, 7))], 1)
    assert values.tolist() == [5.5, 5.5]
    assert other.tolist() == [7.0] * 4
    tape.play([], 5)


def test_a_shared_counter_gives_every_number_once():
    crew = Crew(3)
    tickets, seen = np.zeros(1, np.int64), np.zeros(200_000, np.int64)
    crew.call(lambda _: taken(tickets, len(seen), seen), 3)
    crew.close()
    assert (seen == 1).all()
    assert tickets[0] == len(seen) + 3


def test_what_is_no_counter_is_refused():
    with pytest.raises(EngineError, match="fetch_add takes an array of int64"):
        taken(np.zeros(1), 2, np.zeros(2, np.int64))
