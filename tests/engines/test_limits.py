"""Numbers of worlds, threads and steps are ints within limits."""

from fractions import Fraction

import numpy as np
import pytest

from gazelle import Simulation
from gazelle.engines.limits import integer
from gazelle.errors import EngineError
from gazelle.simulation import TwistInput


@pytest.mark.parametrize("value", [3, np.int8(3), np.uint64(3), np.array(3)])
def test_ints_of_any_kind_are_ints(value):
    number = integer("the number of worlds", value)
    assert (number, type(number)) == (3, int)


@pytest.mark.parametrize(
    "value",
    [True, np.bool_(True), 1.0, Fraction(1), "1", None, [1], np.array([1, 2]), 0, -1, 10**30],
)
@pytest.mark.parametrize(
    "make",
    [
        lambda value: integer("a", value),
        lambda value: Simulation("empty", nworld=value, threads=1),
        lambda value: TwistInput(value, "cmd_vel"),
    ],
)
def test_what_is_no_int_is_refused(make, value):
    with pytest.raises(EngineError, match=r"must be (an int|at least 1)"):
        make(value)
