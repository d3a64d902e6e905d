"""What operators and functions of kernels do, in Python: the same bits, if more slowly."""

from __future__ import annotations

import functools
import math
import operator
from collections.abc import Callable
from fractions import Fraction
from typing import Any, Final

import numpy as np

from gazelle.engines.native.calls import fused, lesser
from gazelle.engines.native.kinds import WIDTH
from gazelle.engines.native.machine import fuses

_ALL: Final[int] = 1 << WIDTH
_HALF: Final[int] = 1 << (WIDTH - 1)
_PLAIN: Final[dict[str, Callable[[Any, Any], Any]]] = {
    "Add": operator.add, "Sub": operator.sub, "Mult": operator.mul, "BitAnd": operator.and_,
    "BitOr": operator.or_, "BitXor": operator.xor,
}  # fmt: skip


def wrapped(value: int) -> int:
    """A whole number in 64 bits with a sign."""
    return int((int(value) + _HALF) % _ALL - _HALF)


def binary(name: str, a: Any, b: Any) -> Any:
    """Two numbers under an operator, by the name of its class in ``ast``."""
    if name == "Div" or isinstance(a, float) or isinstance(b, float):
        return _real(name, float(a), float(b))
    if isinstance(a, np.uint64) or isinstance(b, np.uint64):
        return np.uint64(_whole(name, int(a), int(b), _ALL - 1) % _ALL)
    if isinstance(a, (bool, np.bool_)) and isinstance(b, (bool, np.bool_)) and "Bit" in name:
        return bool(_PLAIN[name](bool(a), bool(b)))
    return wrapped(_whole(name, int(a), int(b), -1))


def _real(name: str, a: float, b: float) -> float:
    if name == "Div":
        return _over(a, b)
    if name == "Mod":
        return math.nan if b == 0.0 or math.isinf(a) else a % b
    if name == "Pow":
        return _power(a, b)
    return float(_PLAIN[name](a, b))


def _whole(name: str, a: int, b: int, left: int) -> int:
    """An operator of whole numbers; ``left`` is of a number -1 when all bits are gone."""
    if name in ("FloorDiv", "Mod"):
        return 0 if b == 0 else a // b if name == "FloorDiv" else a % b
    if name == "LShift":
        return a << b if 0 <= b < WIDTH else 0
    if name == "RShift":
        return a >> b if 0 <= b < WIDTH else left if a < 0 else 0
    if name == "Pow":
        return int(a**b)
    return int(_PLAIN[name](a, b))


def _over(a: float, b: float) -> float:
    if b != 0.0:
        return a / b
    return (
        math.nan
        if a == 0.0 or math.isnan(a)
        else math.copysign(math.inf, a) * math.copysign(1.0, b)
    )


def _power(a: float, b: float) -> float:
    odd = math.isfinite(b) and abs(math.fmod(b, 2.0)) == 1.0
    sign = -1.0 if odd and math.copysign(1.0, a) < 0.0 else 1.0
    if a == 0.0 and b < 0.0:
        return sign * math.inf
    try:
        return math.pow(a, b)
    except OverflowError:
        return sign * math.inf
    except ValueError:
        return math.nan


def squared(a: Any) -> Any:
    """A second power, which is a product."""
    return binary("Mult", a, a)


def negative(a: Any) -> Any:
    """-a."""
    if isinstance(a, float):
        return -a
    return np.uint64(-int(a) % _ALL) if isinstance(a, np.uint64) else wrapped(-int(a))


def whole(value: Any) -> int:
    """``int`` in kernels: 0 of what is no number, and the ends of what is beyond."""
    if not isinstance(value, float):
        return wrapped(value)
    if math.isnan(value):
        return 0
    return int(min(max(value, -_HALF), _HALF - 1))


def _bits(value: Any) -> np.uint64:
    if not isinstance(value, float):
        return np.uint64(int(value) % _ALL)
    return np.uint64(0 if math.isnan(value) else int(min(max(value, 0), _ALL - 1)))


def _absolute(value: Any) -> Any:
    if isinstance(value, (float, np.uint64)):
        return abs(value)
    return wrapped(abs(int(value)))


def _fused(a: float, b: float, c: float) -> float:
    a, b, c = float(a), float(b), float(c)
    if not fuses() or not all(map(math.isfinite, (a, b, c))):
        return a * b + c
    exact = Fraction(a) * Fraction(b) + Fraction(c)
    if exact == 0:
        return a * b + c  # zero as it is, with its sign
    try:
        return float(exact)
    except OverflowError:
        return math.inf if exact > 0 else -math.inf


def _lawless(function: Callable[[float], float]) -> Callable[[Any], float]:
    """A function that gives no number where it has no value, instead of an error."""

    @functools.wraps(function)
    def lawless(value: Any) -> float:
        try:
            return function(float(value))
        except ValueError:
            return math.nan

    return lawless


def _log(value: Any) -> float:
    return -math.inf if value == 0 else _lawless(math.log)(value)


def _of_numpy(function: Callable[..., Any]) -> Callable[..., float]:
    return lambda *values: float(function(*map(float, values)))


TWINS: Final[dict[Any, Callable[..., Any]]] = {
    math.sqrt: _lawless(math.sqrt), math.sin: _lawless(math.sin), math.cos: _lawless(math.cos),
    math.log: _log, math.floor: _of_numpy(np.floor), math.ceil: _of_numpy(np.ceil),
    np.rint: _of_numpy(np.rint), math.hypot: _of_numpy(np.hypot), math.atan2: math.atan2,
    abs: _absolute, int: whole, np.int64: whole, np.uint64: _bits, np.float64: float,
    fused: _fused, lesser: min,
}  # fmt: skip
