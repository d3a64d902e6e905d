"""Arithmetic and comparisons in kernels, with Python's meaning; see the package for what differs."""

from __future__ import annotations

import ast
import operator
from typing import Any, Final

from gazelle.engines.native.code import Code, constant
from gazelle.engines.native.kinds import BITS, REAL, TRUTH, WHOLE, WIDTH, Value
from gazelle.errors import EngineError

_REAL: Final[dict[type, str]] = {
    ast.Add: "fadd",
    ast.Sub: "fsub",
    ast.Mult: "fmul",
    ast.Div: "fdiv",
}
_WHOLE: Final[dict[type, str]] = {
    ast.Add: "add", ast.Sub: "sub", ast.Mult: "mul", ast.BitAnd: "and", ast.BitOr: "or",
    ast.BitXor: "xor", ast.LShift: "shl",
}  # fmt: skip
_FOLDED: Final[dict[type, Any]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
    ast.Pow: operator.pow, ast.FloorDiv: operator.floordiv, ast.Mod: operator.mod,
}  # fmt: skip
_COMPARED: Final = {
    ast.Lt: ("olt", "slt"), ast.LtE: ("ole", "sle"), ast.Gt: ("ogt", "sgt"),
    ast.GtE: ("oge", "sge"), ast.Eq: ("oeq", "eq"), ast.NotEq: ("une", "ne"),
}  # fmt: skip


def binary(code: Code, kind: type, a: Value, b: Value) -> Value:
    """``a`` and ``b`` under an operator, by its class in ``ast``."""
    _numbers(a, b)
    plain = isinstance(a.known, (int, float)) and isinstance(b.known, (int, float))
    if plain and kind in _FOLDED:
        return folded(kind, a.known, b.known)
    if kind is ast.Pow:
        return power(code, a, b)
    if a.kind == TRUTH and b.kind == TRUTH and kind in (ast.BitAnd, ast.BitOr, ast.BitXor):
        return code.get(TRUTH, f"{_WHOLE[kind]} i1 {a.text}, {b.text}")
    if kind is ast.Div or REAL in (a.kind, b.kind):
        return real(code, kind, code.real(a), code.real(b))
    if BITS in (a.kind, b.kind):
        return bits(code, kind, a, b)
    return whole(code, kind, code.turned(a, WHOLE), code.turned(b, WHOLE))


def whole(code: Code, kind: type, a: Value, b: Value) -> Value:
    """An operator of whole numbers, which wrap around."""
    if kind in (ast.FloorDiv, ast.Mod):
        return divided(code, kind, a, b)
    if kind in (ast.LShift, ast.RShift):
        return shifted(code, kind, a, b)
    if kind not in _WHOLE:
        raise EngineError(f"kernels know no operator {kind.__name__} of whole numbers")
    return code.get(WHOLE, f"{_WHOLE[kind]} i64 {a.text}, {b.text}")


def _numbers(*values: Value) -> None:
    if not all(isinstance(value.kind, str) and value.kind != "void" for value in values):
        raise EngineError("operators take numbers, not arrays or tuples")


def folded(kind: type, a: float, b: float) -> Value:
    """An operator of numbers that are known."""
    try:
        return constant(_FOLDED[kind](a, b))
    except ArithmeticError as error:
        raise EngineError(f"{a} and {b} have no {kind.__name__}") from error


def real(code: Code, kind: type, a: Value, b: Value) -> Value:
    """An operator of real numbers."""
    if kind is ast.Mod:
        return remainder(code, a, b)
    if kind not in _REAL:
        raise EngineError(f"kernels know no operator {kind.__name__} of real numbers")
    return code.get(REAL, f"{_REAL[kind]} double {a.text}, {b.text}")


def bits(code: Code, kind: type, a: Value, b: Value) -> Value:
    """An operator of numbers without a sign, which wrap around."""
    if a.kind != b.kind:
        raise EngineError("numbers with and without a sign do not mix; say which is meant")
    if kind in (ast.LShift, ast.RShift):
        return shifted(code, kind, a, b)
    if kind not in _WHOLE:
        raise EngineError(f"kernels know no operator {kind.__name__} of numbers without a sign")
    return code.get(BITS, f"{_WHOLE[kind]} i64 {a.text}, {b.text}")


def shifted(code: Code, kind: type, a: Value, b: Value) -> Value:
    """A number moved by some bits; by 64 or more, nothing but the sign is left of it."""
    name = "shl" if kind is ast.LShift else "lshr" if a.kind == BITS else "ashr"
    if b.known is not None and 0 <= b.known < WIDTH:
        return code.get(a.kind, f"{name} i64 {a.text}, {b.text}")
    most = code.get(WHOLE, f"call i64 @llvm.umin.i64(i64 {b.text}, i64 {WIDTH - 1})")
    code.declared["llvm.umin.i64"] = "declare i64 @llvm.umin.i64(i64, i64)"
    moved = code.get(a.kind, f"{name} i64 {a.text}, {most.text}")
    if name == "ashr":
        return moved
    inside = code.get(TRUTH, f"icmp ult i64 {b.text}, {WIDTH}")
    return code.get(a.kind, f"select i1 {inside.text}, i64 {moved.text}, i64 0")


def power(code: Code, a: Value, b: Value) -> Value:
    """A power; squares are products, as all known powers of whole numbers are."""
    if b.known == 2:
        return binary(code, ast.Mult, a, a)
    if BITS in (a.kind, b.kind):
        raise EngineError("kernels know no powers of numbers without a sign")
    if REAL not in (a.kind, b.kind):
        if b.known is None or not 0 <= b.known < WIDTH:
            raise EngineError("powers of whole numbers must be known, and from 0 to 63")
        made = constant(1)
        for _ in range(b.known):
            made = binary(code, ast.Mult, made, a)
        return made
    code.declared["llvm.pow.f64"] = "declare double @llvm.pow.f64(double, double)"
    a, b = code.real(a), code.real(b)
    return code.get(REAL, f"call double @llvm.pow.f64(double {a.text}, double {b.text})")


def remainder(code: Code, a: Value, b: Value) -> Value:
    """The remainder of real numbers, of the sign of b."""
    rest = code.get(REAL, f"frem double {a.text}, {b.text}")
    moved = code.get(REAL, f"fadd double {rest.text}, {b.text}")
    below = [code.get(TRUTH, f"fcmp olt double {each.text}, 0.0") for each in (rest, b)]
    other = code.get(TRUTH, f"xor i1 {below[0].text}, {below[1].text}")
    made = code.get(REAL, f"select i1 {other.text}, double {moved.text}, double {rest.text}")
    code.declared["llvm.copysign.f64"] = "declare double @llvm.copysign.f64(double, double)"
    zero = code.get(REAL, f"call double @llvm.copysign.f64(double 0.0, double {b.text})")
    some = code.get(TRUTH, f"fcmp une double {rest.text}, 0.0")
    return code.get(REAL, f"select i1 {some.text}, double {made.text}, double {zero.text}")


def divided(code: Code, kind: type, a: Value, b: Value) -> Value:
    """The quotient, rounded down, or the remainder of whole numbers; 0 if ``b`` is 0.

    The processor would stop the process at a division by 0, and at that of the least number by
    -1; both are done by 1 here, and put right.
    """
    if b.known is not None and b.known not in (0, -1):
        return _divided(code, kind, a, b)
    if b.known == 0:
        raise EngineError("kernels do not divide whole numbers by 0")
    above = code.get(WHOLE, f"add i64 {b.text}, 1")
    special = code.get(TRUTH, f"icmp ult i64 {above.text}, 2")
    by = code.get(WHOLE, f"select i1 {special.text}, i64 1, i64 {b.text}")
    made = _divided(code, kind, a, by)
    if kind is ast.Mod:
        return made
    turned = code.get(WHOLE, f"mul i64 {a.text}, {b.text}")
    return code.get(WHOLE, f"select i1 {special.text}, i64 {turned.text}, i64 {made.text}")


def _divided(code: Code, kind: type, a: Value, b: Value) -> Value:
    rest = code.get(WHOLE, f"srem i64 {a.text}, {b.text}")
    signs = code.get(WHOLE, f"xor i64 {rest.text}, {b.text}")
    other = code.get(TRUTH, f"icmp slt i64 {signs.text}, 0")
    some = code.get(TRUTH, f"icmp ne i64 {rest.text}, 0")
    low = code.get(TRUTH, f"and i1 {other.text}, {some.text}")
    if kind is ast.Mod:
        moved = code.get(WHOLE, f"add i64 {rest.text}, {b.text}")
        return code.get(WHOLE, f"select i1 {low.text}, i64 {moved.text}, i64 {rest.text}")
    share = code.get(WHOLE, f"sdiv i64 {a.text}, {b.text}")
    less = code.get(WHOLE, f"sext i1 {low.text} to i64")
    return code.get(WHOLE, f"add i64 {share.text}, {less.text}")


def compared(code: Code, kind: type, a: Value, b: Value) -> Value:
    """Whether ``a`` and ``b`` are as an operator says, by its class in ``ast``."""
    if kind not in _COMPARED:
        raise EngineError(f"kernels know no comparison {kind.__name__}")
    _numbers(a, b)
    ordered, signed = _COMPARED[kind]
    if REAL in (a.kind, b.kind):
        a, b = code.real(a), code.real(b)
        return code.get(TRUTH, f"fcmp {ordered} double {a.text}, {b.text}")
    if BITS in (a.kind, b.kind):
        if any(v.kind != BITS and (v.known is None or v.known < 0) for v in (a, b)):
            raise EngineError("numbers with and without a sign do not mix; say which is meant")
        signed = signed.replace("s", "u") if signed.startswith("s") else signed
    a = code.turned(a, WHOLE) if a.kind == TRUTH else a
    b = code.turned(b, WHOLE) if b.kind == TRUTH else b
    return code.get(TRUTH, f"icmp {signed} i64 {a.text}, {b.text}")


def negative(code: Code, a: Value) -> Value:
    """-a."""
    if isinstance(a.known, (int, float)):
        return constant(-a.known)
    if a.kind == REAL:
        return code.get(REAL, f"fneg double {a.text}")
    if a.kind == BITS:
        return code.get(BITS, f"sub i64 0, {a.text}")
    _numbers(a)
    return code.get(WHOLE, f"sub i64 0, {code.turned(a, WHOLE).text}")
