"""Kernels do what the same lines do in the interpreter."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.engines.native import Native, each, machine
from gazelle.errors import EngineError

WHOLE = st.integers(-1000, 1000)
REAL = st.floats(-1e6, 1e6, allow_nan=False)


def whole_numbers(a, b):
    low = min(a, b)
    return a // b, a % b, abs(a), low, a - 3 * b, (a & 7) | (b & 8), a >> 2


def real_numbers(a, b):
    ratio = a / b if b != 0.0 else 0.0
    return ratio, max(a, b), math.floor(a) + 0.0, math.sqrt(a * a + b * b), -a, float(int(a)), a * a


def choices(a, b):
    n = 0
    for k in range(10, 0, -3):
        if k == a or (b > 3 and k > 5):
            continue
        n += k if 0 < a <= 5 else 2 * k
        if n > 40:
            break
    while n < 0 and n != -7:
        n += 1
    return n


def table(values, marks):
    total = 0.0
    for r in range(values.shape[0]):
        row = values[r]
        for k in range(len(row)):
            row[k] += 1.0
            total += values[r, k] if marks[r] else -values[r, k]
    for mark in marks[:1]:
        total += 100.0 if mark else 0.0
    return total, values.size


def hashed(value):
    value += np.uint64(0x9E3779B97F4A7C15)
    value = (value ^ (value >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    return value ^ (value >> np.uint64(31))


@given(WHOLE, WHOLE.filter(bool))
def test_whole_numbers_are_divided_as_python_does(a, b):
    assert Native(whole_numbers)(a, b) == whole_numbers(a, b)


@given(REAL, REAL)
def test_real_numbers_are_the_same_bits(a, b):
    assert Native(real_numbers)(a, b) == real_numbers(a, b)


@given(WHOLE, WHOLE)
def test_loops_and_conditions_go_the_same_way(a, b):
    assert Native(choices)(a, b) == choices(a, b)


def test_arrays_are_read_and_written_in_place():
    values, marks = np.arange(6.0).reshape(2, 3), np.array([True, False])
    own = values.copy()
    assert Native(table)(own, marks) == table(values, marks)
    assert (own == values).all()


def test_numbers_without_a_sign_wrap_around():
    with np.errstate(over="ignore"):
        assert Native(hashed)(np.uint64(2**63 + 5)) == hashed(np.uint64(2**63 + 5))


@given(st.integers(0, 40))
def test_rounds_in_any_order_give_what_rounds_in_turn_do(count):
    values = np.linspace(-3.0, 5.0, count)
    own = values.copy()
    assert Native(squared)(own, 1.0) == squared(values, 1.0)
    assert (own == values).all()


def squared(values, least):
    below = 0
    for k in each(0, values.shape[0]):
        below += 1 if values[k] < least else 0
        values[k] = values[k] * values[k] if values[k] > 0.0 else -values[k]
    return below


def test_what_is_no_number_becomes_zero_and_what_is_too_large_the_end():
    whole = Native(to_whole)
    assert [whole(math.nan), whole(-math.inf), whole(1e300)] == [0, -(2**63), 2**63 - 1]


def to_whole(a):
    return int(a)


def test_what_kernels_cannot_do_is_refused_with_its_line():
    with pytest.raises(EngineError, match=r"test_kernels.py:\d+: <listed>: kernels know no List"):
        Native(listed)(1)


def test_variables_may_have_annotations():
    assert Native(annotated)(2.0) == annotated(2.0)


def annotated(a):
    b: float = a + 1.0
    c: float
    c = 2.0 * b
    return c


def guarded(a):
    with a:
        b = 1
    return b + 1


def halved(a):  # noqa: RET503  # which is what is refused
    if a > 0.0:
        return a / 2.0


def searched(a):
    for k in range(9):
        a += k
    else:  # noqa: PLW0120  # which is what is refused
        a = 0
    return a


@pytest.mark.parametrize(
    ("function", "line", "message"),
    [(guarded, 1, "kernels know no With: 'with a"), (halved, 0, "on some ways and none"),
     (searched, 1, "kernels know no else of a loop")],
)  # fmt: skip
def test_what_is_refused_is_named_with_file_and_line(function, line, message):
    with pytest.raises(EngineError, match=message) as caught:
        Native(function)(1)
    first = function.__code__.co_firstlineno
    place = (caught.value.file, caught.value.line, caught.value.element)
    assert place == (__file__, first + line, function.__name__)


def test_a_kernel_without_source_is_refused():
    with pytest.raises(EngineError, match="no source of the kernel <lambda>"):
        Native(lambda a: a)(1)


def listed(a):
    return [a]


def test_strided_arrays_are_refused():
    with pytest.raises(EngineError, match="contiguous"):
        Native(table)(np.zeros((4, 4))[:, ::2], np.ones(4, bool))


def test_a_call_sees_new_values_of_the_same_kind():
    double = Native(doubled)
    assert [double(x) for x in (1.0, 2.0, 2.0, 1)] == [2.0, 4.0, 4.0, 2]


def test_a_call_that_was_refused_leaves_nothing_behind():
    sums, first, second = Native(summed), np.ones(3), np.zeros((2, 50))
    for _ in range(2):
        assert sums(first, first) == 6.0
        with pytest.raises(EngineError, match="contiguous"):
            sums(np.zeros(50), second[:, ::2])


def summed(a, b):
    total = 0.0
    for k in range(len(a)):
        total += a[k]
    for k in range(len(b)):
        total += b[k]
    return total


def doubled(a):
    return 2 * a


def test_one_line_says_that_code_is_compiled_where_that_takes_long(caplog, monkeypatch):
    monkeypatch.setattr("gazelle.engines.native.machine._PATIENCE", 0.0)
    own = machine.Machine()
    monkeypatch.setattr(own, "_spent", -1e-9)
    for _ in range(2):
        own.compile("define void @nothing() {\n  ret void\n}\n")
    assert [record.getMessage() for record in caplog.records] == [
        "native code is compiled for this machine, which is done once"
    ]
