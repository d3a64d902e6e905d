"""Kernels run by Python, line by line: slowly, with its debugger, and with checked indices.

Their source is run as it is but for what Python does otherwise than machine code: operators,
some functions and elements go through ``twins`` and what is here, so that results are the same
bits.
"""

from __future__ import annotations

import ast
import copy
import functools
from collections.abc import Callable
from types import FunctionType
from typing import Any

import numpy as np

from gazelle.engines.native.source import tree_of
from gazelle.engines.native.twins import TWINS, binary, negative, squared, whole


def interpreted(function: FunctionType) -> Callable[..., Any]:
    """A kernel that Python runs.

    Raises:
        EngineError: When it is called: there is no source of it.
    """

    @functools.wraps(function)
    def run(*values: Any) -> Any:
        return _rewritten(function)(*values)

    return run


@functools.cache
def _rewritten(function: FunctionType) -> Callable[..., Any]:
    tree = copy.deepcopy(tree_of(function))
    tree.decorator_list, tree.returns = [], None
    for argument in tree.args.args:
        argument.annotation = None
    module = ast.Module([_Rewriter().visit(tree)], [])
    names = {**function.__globals__, **_HELPERS}
    code = compile(ast.fix_missing_locations(module), function.__code__.co_filename, "exec")
    exec(code, names)  # noqa: S102  # what the file says already runs in this process
    made: Callable[..., Any] = names[function.__name__]
    return made


class _Rewriter(ast.NodeTransformer):
    """Lets a kernel call helpers where Python differs from machine code."""

    def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
        self.generic_visit(node)
        is_square = isinstance(node.right, ast.Constant) and node.right.value == 2
        if isinstance(node.op, ast.Pow) and is_square:
            return _call(node, "_squared", node.left)
        return _call(node, "_binary", _name_of(node.op), node.left, node.right)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> ast.expr:
        self.generic_visit(node)
        return _call(node, "_negative", node.operand) if isinstance(node.op, ast.USub) else node

    def visit_AugAssign(self, node: ast.AugAssign) -> ast.stmt:
        self.generic_visit(node)
        name = _name_of(node.op)
        if isinstance(node.target, ast.Subscript):
            parts = (node.target.value, node.target.slice, name, node.value)
            return ast.copy_location(ast.Expr(_call(node, "_change", *parts)), node)
        before = ast.Name(ast.unparse(node.target), ast.Load())
        made = _call(node, "_binary", name, before, node.value)
        return ast.copy_location(ast.Assign([node.target], made), node)

    def visit_Assign(self, node: ast.Assign) -> ast.stmt:
        target, value = node.targets[0], node.value
        count = len(target.elts) if isinstance(target, ast.Tuple) else None
        if count is None:
            return self.generic_visit(node)  # type: ignore[return-value]  # a statement
        if isinstance(value, ast.BinOp):
            sides = self.visit(value.left), self.visit(value.right)
            parts = (_name_of(value.op), *sides, ast.Constant(count))
            node.value = _call(node, "_pairs", *parts)
        else:
            node.value = _call(node, "_parts", self.visit(value), ast.Constant(count))
        node.targets = [self.visit(each) for each in node.targets]
        return node

    def visit_Subscript(self, node: ast.Subscript) -> ast.expr:
        self.generic_visit(node)
        if isinstance(node.ctx, ast.Load) and isinstance(node.slice, ast.Slice):
            nothing = ast.Constant(None)
            ends = node.slice.lower or nothing, node.slice.upper or nothing
            return _call(node, "_between", node.value, *ends)
        if isinstance(node.ctx, ast.Load):
            return _call(node, "_element", node.value, node.slice)
        held = ast.NamedExpr(ast.Name("_held", ast.Store()), node.value)
        node.slice = _call(node, "_place", ast.Name("_held", ast.Load()), node.slice)
        node.value = held
        return node

    def visit_For(self, node: ast.For) -> ast.stmt:
        self.generic_visit(node)
        if isinstance(node.iter, ast.Call) and isinstance(node.iter.func, ast.Call):
            node.iter.args = [_call(each, "_whole", each) for each in node.iter.args]
        else:
            node.iter = _call(node.iter, "_items", node.iter)
        return node

    def visit_Call(self, node: ast.Call) -> ast.expr:
        self.generic_visit(node)
        node.func = _call(node.func, "_twin", node.func)
        return node


def _call(place: ast.AST, name: str, *values: ast.expr) -> ast.expr:
    made = ast.Call(ast.Name(name, ast.Load()), list(values), [])
    return ast.fix_missing_locations(ast.copy_location(made, place))


def _name_of(op: ast.operator) -> ast.expr:
    return ast.Constant(type(op).__name__)


def _twin(function: Any) -> Any:
    if getattr(function, "is_native", False):
        return _rewritten(function.function)
    try:
        return TWINS.get(function, function)
    except TypeError:  # what has no hash
        return function


def _place(array: Any, indices: Any) -> Any:
    """Indices that an array has."""
    row = indices if isinstance(indices, tuple) else (indices,)
    for index, size in zip(row, np.shape(array), strict=False):
        if not 0 <= index < size:
            raise IndexError(f"index {index} of an axis of {size}")
    return tuple(int(index) for index in row)


def _element(owner: Any, indices: Any) -> Any:
    if isinstance(owner, tuple):
        return owner[indices]
    return _plain(owner[_place(owner, indices)])


def _plain(value: Any) -> Any:
    """What machine code has of an element: Python's numbers, but for those without a sign."""
    if isinstance(value, (np.ndarray, np.uint64)):
        return value
    return value.item()


def _change(array: Any, indices: Any, name: str, value: Any) -> None:
    array[_place(array, indices)] = binary(name, _element(array, indices), value)


def _between(array: Any, first: int | None, last: int | None) -> Any:
    first, last = first or 0, len(array) if last is None else last
    if first < 0 or last > len(array):
        raise IndexError(f"{first} to {last} of an axis of {len(array)}")
    return array[first : max(first, last)]


def _items(array: Any) -> Any:
    return [_plain(each) for each in array]


def _parts(value: Any, count: int) -> Any:
    if isinstance(value, np.ndarray):
        return tuple(_element(value, place) for place in range(count))
    return value


def _pairs(name: str, left: Any, right: Any, count: int) -> Any:
    return tuple(
        binary(name, _element(left, place), _element(right, place)) for place in range(count)
    )


_HELPERS: dict[str, Any] = {
    "_binary": binary, "_squared": squared, "_negative": negative, "_whole": whole,
    "_twin": _twin, "_place": _place, "_element": _element, "_change": _change,
    "_between": _between, "_items": _items, "_parts": _parts, "_pairs": _pairs,
}  # fmt: skip
