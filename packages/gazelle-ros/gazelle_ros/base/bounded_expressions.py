"""Python expressions in xacro and launch files, kept from running away and from the machine.

What stands in ``${}`` and ``$(eval)`` is Python. Here names that lead out of the values of
the file are refused, and an expression that would take long or much memory is stopped.
"""

from __future__ import annotations

import ast
import sys
import threading
import types
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from functools import lru_cache
from typing import Any

from gazelle_ros.base import bounded_texts
from gazelle_ros.base.bounded_texts import MAX_LENGTH, MAX_MADE, check_length
from gazelle_ros.base.errors import FormatError

MAX_BITS = 10_000
MAX_STEPS = 200_000

_INNARDS = ("gi_", "cr_", "ag_", "f_", "tb_", "co_")
_LEADS_OUT = {
    name
    for kind in (
        types.AsyncGeneratorType,
        types.CodeType,
        types.CoroutineType,
        types.FrameType,
        types.FunctionType,
        types.GeneratorType,
        types.TracebackType,
    )
    for name in dir(kind)
    if name.startswith(_INNARDS)
}
"""Attributes that lead from a function or generator to Python itself."""
_RUNS_AWAY = {"comb", "factorial", "lcm", "perm"}
_LOOPS = (ast.GeneratorExp, ast.ListComp, ast.SetComp, ast.DictComp, ast.Lambda)


class _ItemCount(threading.local):
    """Number of items that the expressions of a file have made."""

    count = 0


_made = _ItemCount()


def begin() -> None:
    """Reset the count of items, for another file."""
    _made.count = 0


def evaluate(text: str, symbols: dict[str, Any], local: Mapping[str, Any] | None = None) -> Any:
    """Return the value of an expression.

    Args:
        text: Python.
        symbols: Values by name.
        local: Values that go before those.

    Raises:
        FormatError: It names what it may not, or takes too long or too much memory.
    """
    code, loops = _compiled(text.strip())
    symbols.update(__builtins__=_OPERATIONS)
    try:
        with _counted() if loops else nullcontext():
            return eval(code, symbols, local)  # noqa: S307  # expressions of files are checked
    except MemoryError:
        raise FormatError("the expression takes too much memory") from None


@lru_cache(maxsize=4096)
def _compiled(text: str) -> tuple[types.CodeType, bool]:
    """Return the guarded code of an expression, and whether it may loop."""
    try:
        tree = ast.parse(text, "<expression>", "eval")
    except (MemoryError, RecursionError):
        raise FormatError("the expression is nested too deep") from None
    loops = any(isinstance(node, _LOOPS) for node in ast.walk(tree))
    guarded = ast.fix_missing_locations(_Guard().visit(tree))
    return compile(guarded, "<expression>", "eval"), loops


def evaluate_plain(text: str, _: dict[str, Any], local: Mapping[str, Any]) -> Any:
    """Return the value of a ``$(eval)``, which may use some of Python's own functions.

    Raises:
        FormatError: As ``evaluate``.
    """
    return evaluate(text, dict(_BUILTINS), local)


class _Guard(ast.NodeTransformer):
    """Refuses names, and puts checked functions in the place of dear operations."""

    def visit_Name(self, node: ast.Name) -> ast.AST:
        """Check a name: a file may call its properties almost as it likes."""
        if node.id.startswith("__") or node.id in _RUNS_AWAY:
            raise _refused(node.id)
        return node

    def visit_Attribute(self, node: ast.Attribute) -> ast.AST:
        """Check an attribute."""
        if node.attr.startswith("_") or node.attr in _LEADS_OUT | _RUNS_AWAY:
            raise _refused(node.attr)
        return self.generic_visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        """Check powers, products and shifts when they are computed."""
        self.generic_visit(node)
        name = _CHECKED.get(type(node.op))
        return node if name is None else _call(name, node.left, node.right)

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Check methods that make long texts."""
        self.generic_visit(node)
        if isinstance(node.func, ast.Attribute) and node.func.attr in bounded_texts.METHODS:
            method = ast.Constant(node.func.attr)
            return _call(_CALL, node.func.value, method, *node.args, keywords=node.keywords)
        return node

    def visit_FormattedValue(self, node: ast.FormattedValue) -> ast.AST:
        """Check how wide an f-string writes a value."""
        self.generic_visit(node)
        spec = node.format_spec or ast.Constant("")
        written = _call(_FORMATTED, node.value, ast.Constant(node.conversion), spec)
        return ast.FormattedValue(written, -1, None)


def _refused(name: str) -> FormatError:
    return FormatError(f"the name '{name}' may not be used in an expression")


def _call(name: str, *arguments: ast.expr, keywords: Sequence[ast.keyword] = ()) -> ast.Call:
    return ast.Call(ast.Name(name, ast.Load()), list(arguments), list(keywords))


def _bits(value: object) -> int:
    return value.bit_length() if isinstance(value, int) else 0


def _power(base: Any, exponent: Any) -> Any:
    if isinstance(exponent, int) and _bits(base) * abs(exponent) > MAX_BITS:
        raise FormatError("the expression makes a number of too many digits")
    return base**exponent


def _product(left: Any, right: Any) -> Any:
    for one, other in ((left, right), (right, left)):
        if isinstance(one, str | list | tuple | bytes) and isinstance(other, int):
            check_length(len(one) * other)
            _count(len(one) * other)
    if _bits(left) + _bits(right) > MAX_BITS:
        raise FormatError("the expression makes a number of too many digits")
    return left * right


def _shift(value: Any, places: Any) -> Any:
    if isinstance(places, int) and _bits(value) + places > MAX_BITS:
        raise FormatError("the expression makes a number of too many digits")
    return value << places


def _sum(left: Any, right: Any) -> Any:
    if isinstance(left, str | list | tuple | bytes) and isinstance(right, type(left)):
        _count(len(left) + len(right))
    return left + right


def _count(length: int) -> None:
    """Count items that are made; a sum may be longer than what one product makes."""
    _made.count += max(0, length)
    if _made.count > MAX_MADE:
        raise FormatError(f"the expressions make more than {MAX_MADE:,} items")


def bounded_range(*arguments: int) -> range:
    """Return ``range`` of at most ``MAX_LENGTH`` numbers.

    Raises:
        FormatError: It is longer.
    """
    found = range(*arguments)
    check_length(MAX_LENGTH + 1 if found[MAX_LENGTH:] else 0)
    _count(len(found))
    return found


def no_vars(*_: object) -> None:
    """Replace ``vars``, which leads from any type to what types are made of.

    Raises:
        FormatError: Always.
    """
    raise _refused("vars")


@contextmanager
def _counted() -> Iterator[None]:
    """Stop after ``MAX_STEPS`` lines and calls of Python."""
    left = MAX_STEPS

    def step(_: types.FrameType, __: str, ___: Any) -> Callable[..., Any]:
        nonlocal left
        left -= 1
        if left < 0:
            raise FormatError("the expression takes too long")
        return step

    before = sys.gettrace()
    sys.settrace(step)
    try:
        yield
    finally:
        sys.settrace(before)


_POWER, _PRODUCT, _SHIFT, _SUM = "<power>", "<product>", "<shift>", "<sum>"
_CALL, _FORMATTED, _PERCENT = "<call>", "<formatted>", "<percent>"
"""Names that no file can give to its own properties."""
_CHECKED: dict[type[ast.operator], str] = {
    ast.Add: _SUM,
    ast.LShift: _SHIFT,
    ast.Mod: _PERCENT,
    ast.Mult: _PRODUCT,
    ast.Pow: _POWER,
}
_OPERATIONS = {
    _CALL: bounded_texts.call,
    _FORMATTED: bounded_texts.formatted,
    _PERCENT: bounded_texts.percent,
    _POWER: _power,
    _PRODUCT: _product,
    _SHIFT: _shift,
    _SUM: _sum,
}

_BUILTINS: dict[str, Any] = {
    function.__name__: function
    for function in (
        abs,
        all,
        any,
        bool,
        dict,
        divmod,
        enumerate,
        float,
        int,
        len,
        list,
        map,
        max,
        min,
        round,
        set,
        sorted,
        sum,
        tuple,
        zip,
    )
} | {"range": bounded_range, "str": bounded_texts.text}
