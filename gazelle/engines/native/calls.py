"""What kernels may call besides each other: conversions and functions of numbers."""

from __future__ import annotations

import ast
import inspect
import math
import threading
from collections.abc import Callable
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gazelle.engines.native.code import Code, constant, rebuilt, words
from gazelle.engines.native.kinds import BITS, REAL, TRUTH, WHOLE, Array, Value, flat, joined
from gazelle.engines.native.memory import call_at, call_c, floats, integers, long_at
from gazelle.engines.native.operators import compared
from gazelle.errors import EngineError

_OWN: Final[dict[Any, str]] = {
    math.sqrt: "sqrt", math.sin: "sin", math.cos: "cos", math.log: "log", math.floor: "floor",
    math.ceil: "ceil", np.rint: "rint",
}  # fmt: skip
_MOST: Final = 4096  # elements of an array that a kernel makes
_ADDING: Final = threading.Lock()
_OTHERS: Final[dict[Any, str]] = {math.atan2: "atan2", math.hypot: "hypot"}


def each(first: int, last: int) -> range:
    """Indices of rounds of a loop that may be done in any order, or many at once."""
    return range(first, last)


def fused(a: float, b: float, c: float) -> float:
    """The product of two numbers plus a third, rounded once where the processor can."""
    return a * b + c


def lesser(a: float, b: float) -> float:
    """The lesser of two numbers, both of which are numbers; many at once in a loop over ``each``."""
    return min(a, b)


def fetch_add(numbers: NDArray[np.int64], amount: int) -> int:
    """Add to the first of some numbers, which no other thread does meanwhile; what it was."""
    with _ADDING:
        before = int(numbers[0])
        numbers[0] = before + amount
    return before


def call(code: Code, function: Any, values: list[Value]) -> Value:
    """What a function gives.

    Floors and ceilings are real numbers here: ``int`` makes whole ones of them.
    """
    name = getattr(function, "__name__", function)
    if not _is_known(function):
        raise EngineError(f"kernels cannot call {name}")
    if function in _OWN and len(values) == 1:
        return _own(code, f"llvm.{_OWN[function]}.f64", values)
    if function in _OTHERS and len(values) == 2:
        return _own(code, _OTHERS[function], values)
    make = _CALLS.get(function)
    if make is None or not _fits(make, values):
        raise EngineError(f"kernels cannot call {name} with {len(values)} arguments")
    return make(code, *values)


def _is_known(function: Any) -> bool:
    try:
        return function in _OWN or function in _OTHERS or function in _CALLS
    except TypeError:  # what has no hash
        return False


def _fits(make: Callable[..., Value], values: list[Value]) -> bool:
    try:
        inspect.signature(make).bind(None, *values)
    except TypeError:
        return False
    return True


def _own(code: Code, name: str, values: list[Value]) -> Value:
    code.declared[name] = f"declare double @{name}({', '.join(['double'] * len(values))})"
    texts = ", ".join(f"double {code.real(value).text}" for value in values)
    return code.get(REAL, f"call double @{name}({texts})")


def _fused(code: Code, *values: Value) -> Value:
    return _own(code, "llvm.fmuladd.f64", list(values))


def _lesser(code: Code, a: Value, b: Value) -> Value:
    name, a, b = "llvm.minnum.f64", code.real(a), code.real(b)
    code.declared[name] = f"declare double @{name}(double, double)"
    return code.get(REAL, f"call nnan nsz double @{name}(double {a.text}, double {b.text})")


def _absolute(code: Code, value: Value) -> Value:
    if value.kind == REAL:
        return _own(code, "llvm.fabs.f64", [value])
    if value.kind == BITS:
        return value
    value = code.turned(value, WHOLE)
    low = code.get(TRUTH, f"icmp slt i64 {value.text}, 0")
    turned = code.get(WHOLE, f"sub i64 0, {value.text}")
    return choose(code, low, turned, value)


def _least(code: Code, first: Value, second: Value, *others: Value) -> Value:
    for other in (second, *others):
        first = choose(code, compared(code, ast.Lt, other, first), other, first)
    return first


def _most(code: Code, first: Value, second: Value, *others: Value) -> Value:
    for other in (second, *others):
        first = choose(code, compared(code, ast.Gt, other, first), other, first)
    return first


def choose(code: Code, condition: Value, yes: Value, no: Value) -> Value:
    """One of two values that are both made."""
    kind = joined(yes.kind, no.kind)
    if kind is None:
        raise EngineError(f"{yes.kind} or {no.kind} is no one kind of value")
    truth = code.truth(condition).text
    pairs = zip(
        flat(kind), words(code.turned(yes, kind)), words(code.turned(no, kind)), strict=True
    )
    lines = [f"select i1 {truth}, {low} {a}, {low} {b}" for low, a, b in pairs]
    return rebuilt(kind, [code.get(WHOLE, line).text for line in lines])


def _whole(code: Code, value: Value) -> Value:
    """As a whole number, towards zero; 0 of what is no number, and the ends of what is beyond."""
    if isinstance(value.known, int):
        return constant(int(value.known))
    if value.kind == REAL:
        return code.whole(value)
    return Value(WHOLE, value.text if value.kind == BITS else code.turned(value, WHOLE).text)


def _bits(code: Code, value: Value) -> Value:
    if value.kind == REAL:
        return code.whole(value, BITS)
    return Value(BITS, _whole(code, value).text)


def _is_nan(code: Code, value: Value) -> Value:
    text = code.real(value).text
    return code.get(TRUTH, f"fcmp uno double {text}, {text}")


def _is_finite(code: Code, value: Value) -> Value:
    size = _absolute(code, code.real(value))
    return compared(code, ast.Lt, size, constant(math.inf))


def _length(_: Code, value: Value) -> Value:
    if not isinstance(value.kind, Array):
        raise EngineError("only arrays have a length")
    return Value(WHOLE, value.sizes[0])


def _empty(code: Code, shape: Value) -> Value:
    return code.room("float64", _sizes(shape), zero=False)


def _zeros(code: Code, shape: Value) -> Value:
    return code.room("float64", _sizes(shape), zero=True)


def _floats(code: Code, address: Value, count: Value) -> Value:
    return _at(code, "float64", address, count)


def _integers(code: Code, address: Value, count: Value) -> Value:
    return _at(code, "int32", address, count)


def _long_at(code: Code, address: Value) -> Value:
    return code.element(_at(code, "int64", address, constant(1)), [constant(0)])


def _at(code: Code, element: str, address: Value, count: Value) -> Value:
    if not address.kind == count.kind == WHOLE:
        raise EngineError("addresses and sizes are whole numbers")
    place = code.get(WHOLE, f"inttoptr i64 {address.text} to ptr")
    return Value(Array(element, 1), place.text, (count.text,))


def _call_at(code: Code, function: Value, words: Value) -> Value:
    if not function.kind == words.kind == WHOLE:
        raise EngineError("addresses are whole numbers")
    places = [code.get(WHOLE, f"inttoptr i64 {each.text} to ptr") for each in (function, words)]
    code.do(f"call void {places[0].text}(ptr {places[1].text})")
    return constant(0)


def _call_c(code: Code, function: Value, *words: Value) -> Value:
    if not all(each.kind == WHOLE for each in (function, *words)):
        raise EngineError("C functions take addresses and whole numbers here")
    place = code.get(WHOLE, f"inttoptr i64 {function.text} to ptr").text
    code.do(f"call void {place}({', '.join(f'i64 {each.text}' for each in words)})")
    return constant(0)


def _fetch_add(code: Code, numbers: Value, amount: Value) -> Value:
    if numbers.kind != Array("int64", 1) or amount.kind != WHOLE:
        raise EngineError("fetch_add takes an array of int64 with one axis, and a whole number")
    return code.get(WHOLE, f"atomicrmw add ptr {numbers.text}, i64 {amount.text} monotonic")


def _sizes(shape: Value) -> list[int]:
    sizes = [part.known for part in shape.parts or (shape,)]
    if not all(isinstance(size, int) and 0 < size <= _MOST for size in sizes):
        raise EngineError(
            f"the size of an array that a kernel makes must be known, and at most {_MOST}"
        )
    return sizes


_CALLS: Final[dict[Any, Callable[..., Value]]] = {
    abs: _absolute, min: _least, max: _most, float: Code.real, bool: Code.truth, int: _whole,
    np.int64: _whole, np.uint64: _bits, math.isnan: _is_nan, math.isfinite: _is_finite,
    len: _length, fused: _fused, lesser: _lesser, np.float64: Code.real, np.empty: _empty, np.zeros: _zeros,
    floats: _floats, integers: _integers, long_at: _long_at, fetch_add: _fetch_add,
    call_at: _call_at, call_c: _call_c,
}  # fmt: skip
