"""Arithmetic and comparisons in kernels, with Python's meaning."""

from __future__ import annotations

import ast
import operator
from typing import Any, Final

from gazelle.engines.native.code import Code, constant
from gazelle.engines.native.kinds import BITS, REAL, TRUTH, WHOLE, Value
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
    plain = isinstance(a.known, (int, float)) and isinstance(b.known, (int, float))
    if plain and kind in _FOLDED:
        return constant(_FOLDED[kind](a.known, b.known))
    if kind is ast.Pow:
        return power(code, a, b)
    if a.kind == TRUTH and b.kind == TRUTH and kind in (ast.BitAnd, ast.BitOr, ast.BitXor):
        return code.get(TRUTH, f"{_WHOLE[kind]} i1 {a.text}, {b.text}")
    if kind is ast.Div or REAL in (a.kind, b.kind):
        return real(code, kind, code.real(a), code.real(b))
    if (a.kind == BITS) != (b.kind == BITS):
        raise EngineError("numbers with and without a sign do not mix; say which is meant")
    if a.kind == BITS:
        return bits(code, kind, a, b)
    a, b = code.turned(a, WHOLE), code.turned(b, WHOLE)
    if kind in (ast.FloorDiv, ast.Mod):
        return divided(code, kind, a, b)
    if kind is ast.RShift:
        return code.get(WHOLE, f"ashr i64 {a.text}, {b.text}")
    if kind not in _WHOLE:
        raise EngineError(f"kernels know no operator {kind.__name__} of whole numbers")
    flag = " nsw" if kind in (ast.Add, ast.Sub, ast.Mult) else ""
    return code.get(WHOLE, f"{_WHOLE[kind]}{flag} i64 {a.text}, {b.text}")


def real(code: Code, kind: type, a: Value, b: Value) -> Value:
    """An operator of real numbers."""
    if kind is ast.Mod:
        return remainder(code, a, b)
    if kind not in _REAL:
        raise EngineError(f"kernels know no operator {kind.__name__} of real numbers")
    return code.get(REAL, f"{_REAL[kind]} double {a.text}, {b.text}")


def bits(code: Code, kind: type, a: Value, b: Value) -> Value:
    """An operator of numbers without a sign, which wrap around."""
    name = "lshr" if kind is ast.RShift else _WHOLE.get(kind)
    if name is None:
        raise EngineError(f"kernels know no operator {kind.__name__} of numbers without a sign")
    return code.get(BITS, f"{name} i64 {a.text}, {b.text}")


def power(code: Code, a: Value, b: Value) -> Value:
    """A power; squares are products."""
    if b.known == 2:
        return binary(code, ast.Mult, a, a)
    code.declared["llvm.pow.f64"] = "declare double @llvm.pow.f64(double, double)"
    a, b = code.real(a), code.real(b)
    return code.get(REAL, f"call double @llvm.pow.f64(double {a.text}, double {b.text})")


def remainder(code: Code, a: Value, b: Value) -> Value:
    """The remainder of real numbers, of the sign of b."""
    rest = code.get(REAL, f"frem double {a.text}, {b.text}")
    moved = code.get(REAL, f"fadd double {rest.text}, {b.text}")
    product = code.get(REAL, f"fmul double {rest.text}, {b.text}")
    other = code.get(TRUTH, f"fcmp olt double {product.text}, 0.0")
    return code.get(REAL, f"select i1 {other.text}, double {moved.text}, double {rest.text}")


def divided(code: Code, kind: type, a: Value, b: Value) -> Value:
    """The quotient, rounded down, or the remainder of whole numbers."""
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
    ordered, whole = _COMPARED[kind]
    if REAL in (a.kind, b.kind):
        a, b = code.real(a), code.real(b)
        return code.get(TRUTH, f"fcmp {ordered} double {a.text}, {b.text}")
    if BITS in (a.kind, b.kind):
        whole = whole.replace("s", "u") if whole.startswith("s") else whole
    a = code.turned(a, WHOLE) if a.kind == TRUTH else a
    b = code.turned(b, WHOLE) if b.kind == TRUTH else b
    return code.get(TRUTH, f"icmp {whole} i64 {a.text}, {b.text}")


def negative(code: Code, a: Value) -> Value:
    """-a."""
    if isinstance(a.known, (int, float)):
        return constant(-a.known)
    if a.kind == REAL:
        return code.get(REAL, f"fneg double {a.text}")
    return code.get(WHOLE, f"sub i64 0, {code.turned(a, WHOLE).text}")
