"""Expressions in kernels."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Mapping
from typing import Any, Protocol

from gazelle.engines.native.calls import call, choose
from gazelle.engines.native.code import Code, constant
from gazelle.engines.native.kinds import TRUTH, WHOLE, Array, Group, Kind, Value, joined
from gazelle.engines.native.operators import binary, compared, negative
from gazelle.engines.native.wording import spelled, unknown
from gazelle.errors import EngineError

_NOTHING = object()
_CHEAP = (ast.Name, ast.Constant, ast.UnaryOp, ast.BinOp, ast.Load, ast.operator, ast.unaryop)


def _is_cheap(*nodes: ast.expr) -> bool:
    """Whether making values that are not needed costs less than a branch, and does no harm."""
    return all(isinstance(part, _CHEAP) for node in nodes for part in ast.walk(node))


class Linker(Protocol):
    """Makes the other kernels that one calls."""

    def invoke(self, code: Code, callee: Any, values: list[Value]) -> Value:
        """A call of a kernel."""
        ...

    def knows(self, callee: Any) -> bool:
        """Whether something is a kernel."""
        ...


class Expressions:
    """Makes the values of expressions.

    Args:
        code: Gets the lines.
        names: What names mean that are no local variables.
        groups: Arguments that are tuples.
        linker: Makes what is called.
    """

    def __init__(
        self, code: Code, names: Mapping[str, Any], groups: dict[str, Value], linker: Linker
    ) -> None:
        self.code, self._names, self.groups, self._linker = code, names, groups, linker
        self.locals: set[str] = set()

    def value(self, node: ast.expr) -> Value:
        """The value of an expression."""
        make = getattr(self, f"_{type(node).__name__.lower()}", self._unknown)
        try:
            made: Value = make(node)
        except EngineError as error:
            if error.line is not None:
                raise
            raise EngineError(error.message, line=node.lineno) from error
        return made

    def _unknown(self, node: ast.expr) -> Value:
        raise EngineError(unknown(node))

    def meaning(self, node: ast.expr) -> Any:
        """What an expression of names alone stands for, outside of the function."""
        if isinstance(node, ast.Name) and node.id not in self.locals:
            found = self._names.get(node.id, _NOTHING)
            return getattr(builtins, node.id, _NOTHING) if found is _NOTHING else found
        if isinstance(node, ast.Attribute):
            owner = self.meaning(node.value)
            return _NOTHING if owner is _NOTHING else getattr(owner, node.attr, _NOTHING)
        return _NOTHING

    # -- names -------------------------------------------------------------------------------

    def _constant(self, node: ast.Constant) -> Value:
        return constant(node.value)

    def _name(self, node: ast.Name) -> Value:
        if node.id in self.groups:
            return self.groups[node.id]
        if node.id in self.locals:
            return self.code.load(node.id)
        found = self.meaning(node)
        if found is _NOTHING:
            raise EngineError(f"there is no '{node.id}'")
        return constant(found)

    def _attribute(self, node: ast.Attribute) -> Value:
        found = self.meaning(node)
        if found is not _NOTHING:
            return constant(found)
        owner = self.value(node.value)
        if isinstance(owner.kind, Array) and node.attr == "shape":
            parts = tuple(Value(WHOLE, size) for size in owner.sizes)
            return Value(Group((WHOLE,) * len(parts)), parts=parts)
        if isinstance(owner.kind, Array) and node.attr == "size":
            total = Value(WHOLE, owner.sizes[0])
            for size in owner.sizes[1:]:
                total = binary(self.code, ast.Mult, total, Value(WHOLE, size))
            return total
        raise EngineError(f"kernels know no attribute '{node.attr}'")

    def _tuple(self, node: ast.Tuple) -> Value:
        parts = tuple(self.arguments(node.elts))
        return Value(Group(tuple(part.kind for part in parts)), parts=parts)

    # -- elements ----------------------------------------------------------------------------

    def element(self, node: ast.Subscript) -> tuple[Value, list[Value]]:
        """The array that an expression names an element of, and the indices."""
        nodes = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        return self.value(node.value), [self.value(each) for each in nodes]

    def _subscript(self, node: ast.Subscript) -> Value:
        if isinstance(node.slice, ast.Slice):
            return self._slice(self.value(node.value), node.slice)
        owner, indices = self.element(node)
        if isinstance(owner.kind, Group):
            known = indices[0].known
            if not isinstance(known, int) or not 0 <= known < len(owner.parts):
                raise EngineError("which part of a tuple must be known")
            return owner.parts[known]
        return self.code.element(owner, indices)

    def _slice(self, array: Value, part: ast.Slice) -> Value:
        if part.step is not None or not isinstance(array.kind, Array):
            raise EngineError("kernels know no slices with steps")
        first = constant(0) if part.lower is None else self.value(part.lower)
        last = Value(WHOLE, array.sizes[0]) if part.upper is None else self.value(part.upper)
        address = array.text
        if part.lower is not None:
            places = [first, *[constant(0)] * (array.kind.axes - 1)]
            address = self.code.address(array, places)
        size = binary(self.code, ast.Sub, last, first)
        return Value(array.kind, address, (size.text, *array.sizes[1:]))

    # -- numbers -----------------------------------------------------------------------------

    def _binop(self, node: ast.BinOp) -> Value:
        return binary(self.code, type(node.op), self.value(node.left), self.value(node.right))

    def _unaryop(self, node: ast.UnaryOp) -> Value:
        value = self.value(node.operand)
        if isinstance(node.op, ast.Not):
            return self.code.get(TRUTH, f"xor i1 {self.code.truth(value).text}, true")
        if isinstance(node.op, ast.USub):
            return negative(self.code, value)
        raise EngineError(unknown(node.op, node))

    def _compare(self, node: ast.Compare) -> Value:
        if any(isinstance(op, (ast.In, ast.NotIn)) for op in node.ops):
            return self._among(node)
        if len(node.ops) > 1 and not _is_cheap(*node.comparators[1:]):
            return self._chain(node)
        left, values = self.value(node.left), []
        for op, each in zip(node.ops, node.comparators, strict=True):
            right = self.value(each)
            values.append(compared(self.code, type(op), left, right))
            left = right
        return self._all(values, "and")

    def _chain(self, node: ast.Compare) -> Value:
        """Comparisons, of which those after a false one are not made."""
        code, end, left = self.code, self.code.label(), self.value(node.left)
        ways = []
        for place, (op, each) in enumerate(zip(node.ops, node.comparators, strict=True), 1):
            right = self.value(each)
            made = compared(code, type(op), left, right)
            if place == len(node.ops):
                break
            ways.append(f"[ false, %{code.block} ]")
            after = code.label()
            code.fork(made, after, end)
            code.begin(after)
            left = right
        ways.append(f"[ {made.text}, %{code.block} ]")
        code.jump(end)
        code.begin(end)
        return code.get(TRUTH, f"phi i1 {', '.join(ways)}")

    def _among(self, node: ast.Compare) -> Value:
        left, group = self.value(node.left), self.value(node.comparators[0])
        if len(node.ops) > 1 or not group.parts:
            raise EngineError("kernels look for numbers in tuples, one at a time")
        if isinstance(node.ops[0], ast.In):
            return self._all(
                [compared(self.code, ast.Eq, left, part) for part in group.parts], "or"
            )
        parts = [compared(self.code, ast.NotEq, left, part) for part in group.parts]
        return self._all(parts, "and")

    def _all(self, values: list[Value], how: str) -> Value:
        made = values[0]
        for value in values[1:]:
            made = self.code.get(TRUTH, f"{how} i1 {made.text}, {value.text}")
        return made

    # -- choices -----------------------------------------------------------------------------

    def _boolop(self, node: ast.BoolOp) -> Value:
        """The first value that decides, or the last one."""
        code, end = self.code, self.code.label()
        ways, values, gaps = [], [], []
        for each in node.values:
            values.append(self.value(each))
            gaps.append(code.gap())
            ways.append(code.block)
            if each is node.values[-1]:
                break
            after = code.label()
            labels = (end, after) if isinstance(node.op, ast.Or) else (after, end)
            code.fork(values[-1], *labels)
            code.begin(after)
        code.jump(end)
        code.begin(end)
        if all(value.kind == TRUTH for value in values):
            pairs = zip(values, ways, strict=True)
            return code.get(TRUTH, "phi i1 " + ", ".join(f"[ {v.text}, %{w} ]" for v, w in pairs))
        return self._met(values, gaps)

    def _ifexp(self, node: ast.IfExp) -> Value:
        condition = self.value(node.test)
        if _is_cheap(node.body, node.orelse):
            return choose(self.code, condition, self.value(node.body), self.value(node.orelse))
        return self._branched(condition, node)

    def _branched(self, condition: Value, node: ast.IfExp) -> Value:
        code = self.code
        labels, end = (code.label(), code.label()), code.label()
        code.fork(condition, *labels)
        values, gaps = [], []
        for label, arm in zip(labels, (node.body, node.orelse), strict=True):
            code.begin(label)
            values.append(self.value(arm))
            gaps.append(code.gap())
            code.jump(end)
        code.begin(end)
        return self._met(values, gaps)

    def _met(self, values: list[Value], gaps: list[int]) -> Value:
        """That one of some values that was made, where the ways to it meet."""
        kind: Kind | None = values[0].kind
        for value in values[1:]:
            kind = None if kind is None else joined(kind, value.kind)
        if kind is None:
            raise EngineError(f"{' or '.join(str(v.kind) for v in values)} is no one kind of value")
        places = self.code.place(kind)
        for value, gap in zip(values, gaps, strict=True):
            self.code.fill(gap, places, kind, value)
        return self.code.read(places, kind)

    # -- calls -------------------------------------------------------------------------------

    def arguments(self, nodes: list[ast.expr]) -> list[Value]:
        """Values of arguments; tuples after a star are taken apart."""
        values: list[Value] = []
        for node in nodes:
            if isinstance(node, ast.Starred):
                values.extend(self.value(node.value).parts)
            else:
                values.append(self.value(node))
        return values

    def _call(self, node: ast.Call) -> Value:
        callee = self.meaning(node.func)
        if callee is _NOTHING or node.keywords:
            text = spelled(node)
            raise EngineError(
                f"kernels call functions by name, with arguments in order, not {text}"
            )
        values = self.arguments(node.args)
        if self._linker.knows(callee):
            return self._linker.invoke(self.code, callee, values)
        return call(self.code, callee, values)
