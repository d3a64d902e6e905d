"""Every operator does compiled what its twin does, and what Python does where that has a value."""

from __future__ import annotations

import math
import operator
import warnings

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from gazelle.engines.native import Native
from gazelle.engines.native.interpreter import interpreted

LEAST, MOST = -(2**63), 2**63 - 1
EDGES = [LEAST, LEAST + 1, -64, -2, -1, 0, 1, 2, 63, 64, 65, MOST - 1, MOST]
WHOLE = st.sampled_from(EDGES) | st.integers(-100, 100) | st.integers(LEAST, MOST)
BITS = (st.integers(0, 70) | st.integers(0, 2**64 - 1)).map(np.uint64)
EDGES_REAL = [0.0, -0.0, 5e-324, -1e-300, 1.0, -2.5, 1e300, math.inf, -math.inf, math.nan]
REAL = st.sampled_from(EDGES_REAL) | st.floats(-10, 10) | st.floats()
SIGNS = {
    "+": operator.add, "-": operator.sub, "*": operator.mul, "//": operator.floordiv,
    "%": operator.mod, "&": operator.and_, "|": operator.or_, "^": operator.xor,
    "<<": operator.lshift, ">>": operator.rshift, "/": operator.truediv, "**": operator.pow,
    "<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "==": operator.eq,
    "!=": operator.ne,
}  # fmt: skip
COMPARED = ("<", "<=", ">", ">=", "==", "!=")


@pytest.fixture(scope="module")
def kernels(tmp_path_factory):
    """Kernels of two arguments, by what they return."""
    texts = [f"a {sign} b" for sign in SIGNS]
    texts += ["min(a, b)", "max(a, b)", "a and b", "a or b", "-a if a < b else b"]
    texts += ["int(a)", "float(a)", "bool(a)", "abs(a)", "-a", "not a", "math.floor(a)", "a ** 3"]
    texts += ["a < b < a + b", "a in (1, 2, b)", "a not in (1, 2, b)", "np.uint64(a)"]
    texts += ["math.hypot(a, b)", "math.atan2(a, b)", "fused(a, b, a)", "math.sqrt(a)"]
    texts += ["math.sin(a)", "math.log(a)", "np.rint(a)", "math.ceil(a)"]
    lines = ["import math", "import numpy as np", "from gazelle.engines.native import fused"]
    lines += [f"def f{n}(a, b):\n    return {text}" for n, text in enumerate(texts)]
    path = tmp_path_factory.mktemp("kernels") / "operators.py"
    path.write_text("\n".join(lines) + "\n")
    names = {}
    exec(compile(path.read_text(), str(path), "exec"), names)
    functions = {text: names[f"f{n}"] for n, text in enumerate(texts)}
    return {text: (Native(made), interpreted(made)) for text, made in functions.items()}


def same(one, other):
    """Whether numbers have the same bits; what is no number has any."""
    if isinstance(one, float) and math.isnan(one):
        return math.isnan(other)
    if isinstance(one, float) and one == 0.0:
        return other == 0.0 and math.copysign(1.0, one) == math.copysign(1.0, other)
    return bool(one == other)


def check(kernels, text, a, b):
    """Do something both ways; what comes out."""
    native, twin = kernels[text]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        made, own = native(a, b), twin(a, b)
    assert same(made, own), (text, a, b, made, own)
    return made


def python(sign, a, b):
    """What Python has for two numbers; None if it has nothing, or no number of 64 bits."""
    try:
        value = SIGNS[sign](a, b)
    except (ArithmeticError, ValueError, MemoryError):
        return None
    if isinstance(value, complex) or (type(value) is int and not LEAST <= value <= MOST):
        return None
    return value


@pytest.mark.parametrize("sign", ["+", "-", "*", "//", "%", "&", "|", "^", ">>", *COMPARED])
@example(a=LEAST, b=-1)
@example(a=5, b=0)
@given(a=WHOLE, b=WHOLE)
def test_whole_numbers(kernels, sign, a, b):
    made, wanted = check(kernels, f"a {sign} b", a, b), python(sign, a, b)
    assert wanted is None or same(made, wanted)


@given(a=WHOLE, b=st.integers(-3, 130))
def test_bits_are_moved_out(kernels, a, b):
    made = check(kernels, "a << b", a, b)
    assert made == (((a << b) + 2**63) % 2**64 - 2**63 if b >= 0 else 0)


@given(a=st.integers(-(2**53), 2**53), b=st.integers(-(2**53), 2**53))
def test_quotients_of_whole_numbers_are_real(kernels, a, b):
    made, wanted = check(kernels, "a / b", a, b), python("/", a, b)
    assert wanted is None or same(made, wanted)


@pytest.mark.parametrize("sign", ["+", "-", "*", "/", "%", *COMPARED])
@example(a=-1e-300, b=1e-300)
@example(a=1e-300, b=-1e-200)
@given(a=REAL, b=REAL)
def test_real_numbers(kernels, sign, a, b):
    made, wanted = check(kernels, f"a {sign} b", a, b), python(sign, a, b)
    assert wanted is None or same(made, wanted)


@given(a=REAL, b=REAL)
def test_powers(kernels, a, b):
    made, wanted = check(kernels, "a ** b", a, b), python("**", a, b)
    assert wanted is None or same(made, wanted)


@pytest.mark.parametrize("sign", ["+", "-", "*", "&", "|", "^", "<<", ">>", *COMPARED])
@given(a=BITS, b=BITS)
def test_numbers_without_a_sign(kernels, sign, a, b):
    made = check(kernels, f"a {sign} b", a, b)
    with np.errstate(all="ignore"):
        assert made == SIGNS[sign](a, b)


@pytest.mark.parametrize(
    "text",
    ["min(a, b)", "max(a, b)", "a and b", "a or b", "-a if a < b else b", "a < b < a + b",
     "a in (1, 2, b)", "a not in (1, 2, b)"],
)  # fmt: skip
@given(a=REAL | st.integers(-50, 50) | st.booleans(), b=REAL | st.integers(-50, 50))
def test_choices(kernels, text, a, b):
    if " in " in text:
        assume(not math.isnan(b))  # Python finds it in a tuple that holds that very object
    made, wanted = check(kernels, text, a, b), eval(text, {"a": a, "b": b})
    assert made == wanted or (math.isnan(made) and math.isnan(wanted))


@pytest.mark.parametrize(
    "text",
    ["int(a)", "float(a)", "bool(a)", "abs(a)", "-a", "not a", "math.floor(a)", "np.uint64(a)",
     "math.sqrt(a)", "math.sin(a)", "math.log(a)", "np.rint(a)", "math.ceil(a)"],
)  # fmt: skip
@given(a=REAL | WHOLE | BITS | st.booleans())
def test_numbers_of_every_kind_are_turned(kernels, text, a):
    check(kernels, text, a, 0)


@pytest.mark.parametrize("text", ["math.hypot(a, b)", "math.atan2(a, b)", "fused(a, b, a)"])
@given(a=REAL, b=REAL)
def test_functions_of_two(kernels, text, a, b):
    check(kernels, text, a, b)


@given(a=WHOLE)
def test_third_powers_of_whole_numbers_wrap_around(kernels, a):
    assert check(kernels, "a ** 3", a, 0) == (a**3 + 2**63) % 2**64 - 2**63
