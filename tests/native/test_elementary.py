"""Elementary functions against exact ones, and the same bits by Python."""

from __future__ import annotations

import math
import os
import subprocess
import sys

import mpmath
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from gazelle.native.elementary import on_arrays

PLACES = {"sin": 1.0, "cos": 1.0, "log": 1.0, "atan2": 2.0}
"""How far results may be from the exact ones, in units of the last place."""


def one(name, first, second=0.0):
    return float(on_arrays(name, np.array([float(first)]), np.array([float(second)]))[0])


def off(found, exact):
    """Return how far a number is from an exact one, in units of the last place of that."""
    return float(abs(mpmath.mpf(found) - exact) / mpmath.mpf(math.ulp(float(exact))))


@given(st.floats(-1e6, 1e6))
@example(math.pi)
@example(0.5 * math.pi)
@example(1e5 * math.pi)
@example(math.pi / 4)
@example(5e-324)
def test_sine_and_cosine_are_exact_to_the_last_place(x):
    with mpmath.workprec(200):
        assert off(one("sin", x), mpmath.sin(x)) <= PLACES["sin"]
        assert off(one("cos", x), mpmath.cos(x)) <= PLACES["cos"]


@given(st.floats(0.0, exclude_min=True, allow_infinity=False))
@example(1.0)
@example(math.nextafter(1.0, 2.0))
@example(math.nextafter(1.0, 0.0))
@example(5e-324)
def test_logarithms_are_exact_to_the_last_place(x):
    with mpmath.workprec(200):
        assert off(one("log", x), mpmath.log(x)) <= PLACES["log"]


@given(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3))
@example(1.0, 1.0)
@example(1e-3, -1.0)
@example(1e-300, 1e-300)
@example(-5e-324, 1.0)
@example(1e300, 1e300)
@example(1.7e308, -1.7e308)
def test_arc_tangents_are_exact_to_two_places(y, x):
    if x == y == 0.0:
        return
    with mpmath.workprec(2200):
        exact = mpmath.atan2(y, x)
        if abs(exact) > 1e-290:
            assert off(one("atan2", y, x), exact) <= PLACES["atan2"]


@pytest.mark.parametrize("name", PLACES)
def test_many_numbers_are_exact_too(name):
    rng = np.random.default_rng(0)
    first, second = rng.normal(0.0, 3.0, 3000), rng.normal(0.0, 3.0, 3000)
    first = abs(first) if name == "log" else first
    found = on_arrays(name, first, second)
    with mpmath.workprec(120):
        function = getattr(mpmath, name)
        exact = [
            function(a, b) if name == "atan2" else function(a)
            for a, b in zip(map(float, first), map(float, second), strict=True)
        ]
        assert max(map(off, map(float, found), exact)) <= PLACES[name]


@pytest.mark.parametrize("y", [0.0, -0.0, 1.0, -1.0, math.inf, -math.inf])
@pytest.mark.parametrize("x", [0.0, -0.0, 1.0, -1.0, math.inf, -math.inf])
def test_arc_tangents_of_the_ends_are_as_in_c(y, x):
    found, wanted = one("atan2", y, x), math.atan2(y, x)
    assert found == wanted or (x == 0.0 == y and abs(found) == 0.0)


@pytest.mark.parametrize(
    ("name", "x", "wanted"),
    [("log", 0.0, -math.inf), ("log", -1.0, math.nan), ("log", math.inf, math.inf)]
    + [(name, x, math.nan) for name in ("sin", "cos") for x in (math.inf, -math.inf, math.nan)]
    + [("log", math.nan, math.nan), ("atan2", math.nan, math.nan)],
)
def test_what_has_no_value_is_no_number(name, x, wanted):
    np.testing.assert_equal(one(name, x, 1.0), wanted)


@pytest.mark.parametrize("x", [1e7, -3.3e9, 1e15])
def test_far_angles_are_less_exact_but_stay_angles(x):
    assert one("sin", x) == pytest.approx(math.sin(x), abs=1e-15 * abs(x))
    assert one("sin", x) ** 2 + one("cos", x) ** 2 == pytest.approx(1.0, abs=1e-15)


CODE = """
import hashlib, numpy as np
from gazelle.native.elementary import on_arrays
rng = np.random.default_rng(1)
a, b = rng.normal(0.0, 30.0, 4000), rng.normal(0.0, 3.0, 4000)
for name in ("sin", "cos", "atan2", "log"):
    print(hashlib.sha256(on_arrays(name, abs(a) if name == "log" else a, b).tobytes()).hexdigest())
"""


def test_all_builds_and_python_give_the_same_bits():
    def bits(build):
        environment = os.environ | {"GAZELLE_NATIVE": build}
        line = [sys.executable, "-c", CODE]
        done = subprocess.run(line, env=environment, check=True, capture_output=True, text=True)
        return done.stdout

    assert bits("baseline") == bits("") == bits("python")
