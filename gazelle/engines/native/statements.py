"""Statements in kernels: the text of one function, for one set of types of its arguments."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from contextlib import nullcontext
from typing import Any

from gazelle.engines.native.calls import call, each
from gazelle.engines.native.code import Code, TypesChanged, constant, words
from gazelle.engines.native.expressions import Expressions, Linker
from gazelle.engines.native.kinds import (
    BITS,
    WHOLE,
    Array,
    Group,
    Kind,
    Value,
    flat,
    joined,
)
from gazelle.engines.native.operators import binary
from gazelle.engines.native.wording import spelled, unknown
from gazelle.errors import EngineError

_TRIES = 20


class Statements:
    """Makes a function.

    Args:
        tree: Its source.
        kinds: Of its arguments.
        names: What names in it mean that are no local variables.
        linker: Makes what it calls.
        file: Where it is, for messages.
        numbers: Of notes about loops.

    Attributes:
        code: Its lines.
    """

    def __init__(
        self,
        tree: ast.FunctionDef,
        kinds: list[Kind],
        names: Mapping[str, Any],
        linker: Linker,
        file: str,
        numbers: Iterator[int],
    ) -> None:
        self._tree, self._kinds, self._file = tree, kinds, file
        self.code = Code(numbers)
        self._expressions = Expressions(self.code, names, {}, linker)
        self._expressions.locals = {arg.arg for arg in tree.args.args} | {
            node.id
            for node in ast.walk(tree)
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
        }
        self._loops: list[tuple[str, str]] = []

    def make(self) -> None:
        """Make all lines; anew as long as variables turn out to be of other kinds.

        Raises:
            EngineError: It has what kernels may not have.
        """
        self._check()
        for _ in range(_TRIES):
            self.code.clear()
            try:
                self._take_arguments()
                self._all(self._tree.body)
            except TypesChanged:
                continue
            self._end()
            return
        raise self._fault("its types do not settle")

    def _check(self) -> None:
        """Refuse arguments that only the interpreter knows, and ends without a value."""
        args, returns = self._tree.args, _returns(self._tree)
        if args.posonlyargs or args.kwonlyargs or args.vararg or args.kwarg or args.defaults:
            raise self._fault("kernels have plain arguments only")
        valued = [node for node in returns if node.value is not None]
        if valued and (len(valued) < len(returns) or not _ends(self._tree.body)):
            raise self._fault("it returns a value on some ways and none on others")

    def _fault(self, message: str) -> EngineError:
        line, name = self._tree.lineno, self._tree.name
        return EngineError(message, file=self._file, line=line, element=name)

    def _take_arguments(self) -> None:
        names = [arg.arg for arg in self._tree.args.args]
        if len(names) != len(self._kinds):
            raise self._fault(f"it takes {len(names)} arguments, not {len(self._kinds)}")
        for number, (name, kind) in enumerate(zip(names, self._kinds, strict=True)):
            value = argument(f"a{number}", kind)
            if isinstance(kind, Group):
                self._expressions.groups[name] = value
            else:
                self.code.store(name, value)

    def _end(self) -> None:
        self.code.do("ret void" if self.code.result is None else "unreachable")

    def _all(self, nodes: list[ast.stmt]) -> None:
        for node in nodes:
            try:
                getattr(self, f"_{type(node).__name__.lower()}", self._unknown)(node)
            except EngineError as error:
                if error.file is not None:
                    raise
                line = node.lineno if error.line is None else error.line
                raise EngineError(
                    error.message, file=self._file, line=line, element=self._tree.name
                ) from error

    def _unknown(self, node: ast.stmt) -> None:
        raise EngineError(unknown(node))

    # -- values ------------------------------------------------------------------------------

    def _expr(self, node: ast.Expr) -> None:
        if not isinstance(node.value, ast.Constant):
            self._expressions.value(node.value)

    def _assign(self, node: ast.Assign) -> None:
        target = node.targets[0]
        if isinstance(node.value, ast.BinOp) and isinstance(target, ast.Tuple):
            self._give(target, self._element_wise(node.value, len(target.elts)))
            return
        value = self._expressions.value(node.value)
        for each_target in node.targets:
            self._give(each_target, value)

    def _annassign(self, node: ast.AnnAssign) -> None:
        """What comes after the colon is for readers: kinds follow from values."""
        if node.value is not None:
            self._give(node.target, self._expressions.value(node.value))

    def _element_wise(self, node: ast.BinOp, count: int) -> Value:
        """The first elements of what two arrays give under an operator."""
        left, right = self._expressions.value(node.left), self._expressions.value(node.right)
        pairs = [
            [self.code.element(array, [constant(place)]) for array in (left, right)]
            for place in range(count)
        ]
        parts = tuple(binary(self.code, type(node.op), *pair) for pair in pairs)
        return Value(Group(tuple(part.kind for part in parts)), parts=parts)

    def _give(self, target: ast.expr, value: Value) -> None:
        if isinstance(target, ast.Name):
            self.code.store(target.id, value)
        elif isinstance(target, ast.Subscript):
            self.code.put(*self._expressions.element(target), value)
        elif isinstance(target, ast.Tuple) and isinstance(value.kind, Array):
            for place, part in enumerate(target.elts):
                self._give(part, self.code.element(value, [constant(place)]))
        elif isinstance(target, ast.Tuple) and len(target.elts) == len(value.parts):
            for part, its in zip(target.elts, value.parts, strict=True):
                self._give(part, its)
        else:
            raise EngineError(
                f"kernels give values to names, elements and tuples of them, not {spelled(target)}"
            )

    def _augassign(self, node: ast.AugAssign) -> None:
        if isinstance(node.target, ast.Name):
            before = self.code.load(node.target.id)
            made = binary(self.code, type(node.op), before, self._expressions.value(node.value))
            self.code.store(node.target.id, made)
        elif isinstance(node.target, ast.Subscript):
            array, indices = self._expressions.element(node.target)
            before = self.code.element(array, indices)
            made = binary(self.code, type(node.op), before, self._expressions.value(node.value))
            self.code.put(array, indices, made)
        else:
            raise EngineError(f"kernels change names and elements, not {spelled(node.target)}")

    def _return(self, node: ast.Return) -> None:
        if node.value is None:
            self.code.do("ret void")
        else:
            self._return_value(self._expressions.value(node.value))
        self.code.begin(self.code.label())

    def _return_value(self, value: Value) -> None:
        before = value.kind if self.code.result is None else self.code.result
        kind = joined(before, value.kind)
        if kind is None:
            raise EngineError(f"it would return {before} and {value.kind}")
        if isinstance(kind, Array) or (
            isinstance(kind, Group) and any(isinstance(part, Array) for part in kind.parts)
        ):
            raise EngineError("kernels return no arrays; let them write into those they are given")
        known, self.code.result = self.code.result is not None, kind
        if known and kind != before:
            raise TypesChanged
        value = self.code.turned(value, kind)
        made = "undef"
        if isinstance(kind, str):
            self.code.do(f"ret {returned(kind)} {value.text}")
            return
        for place, (low, text) in enumerate(zip(flat(kind), words(value), strict=True)):
            line = f"insertvalue {returned(kind)} {made}, {low} {text}, {place}"
            made = self.code.get(kind, line).text
        self.code.do(f"ret {returned(kind)} {made}")

    # -- ways --------------------------------------------------------------------------------

    def _pass(self, _: ast.Pass) -> None:
        return

    def _if(self, node: ast.If) -> None:
        yes, no, end = self.code.label(), self.code.label(), self.code.label()
        self.code.fork(self._expressions.value(node.test), yes, no if node.orelse else end)
        self.code.begin(yes)
        self._all(node.body)
        self.code.jump(end)
        if node.orelse:
            self.code.begin(no)
            self._all(node.orelse)
            self.code.jump(end)
        self.code.begin(end)

    def _while(self, node: ast.While) -> None:
        if node.orelse:
            raise EngineError("kernels know no else of a loop")
        head, body, end = self.code.label(), self.code.label(), self.code.label()
        self.code.jump(head)
        self.code.begin(head)
        self.code.fork(self._expressions.value(node.test), body, end)
        self.code.begin(body)
        self._loop(node.body, head, end)
        self.code.jump(head)
        self.code.begin(end)

    def _loop(self, body: list[ast.stmt], again: str, end: str) -> None:
        self._loops.append((again, end))
        self._all(body)
        self._loops.pop()

    def _break(self, _: ast.Break) -> None:
        self.code.jump(self._loops[-1][1])
        self.code.begin(self.code.label())

    def _continue(self, _: ast.Continue) -> None:
        self.code.jump(self._loops[-1][0])
        self.code.begin(self.code.label())

    def _for(self, node: ast.For) -> None:
        if node.orelse:
            raise EngineError("kernels know no else of a loop")
        if not isinstance(node.iter, ast.Call):
            self._for_elements(node, self._expressions.value(node.iter))
            return
        callee = self._expressions.meaning(node.iter.func)
        most = 3 if callee is range else 2 if callee is each else 0
        values = [self._whole(value) for value in self._expressions.arguments(node.iter.args)]
        if (
            not 0 < len(values) <= most
            or node.iter.keywords
            or (callee is each and len(values) < 2)
        ):
            raise EngineError(f"kernels loop over ranges and arrays, not {spelled(node.iter)}")
        first, last = (constant(0), values[0]) if len(values) == 1 else (values[0], values[1])
        step = values[2] if len(values) > 2 else constant(1)
        if step.known == 0:
            raise EngineError("a range's step must not be 0")
        self._count(node, first, last, step, free=callee is each)

    def _whole(self, value: Value) -> Value:
        if value.kind != BITS:  # floors and ceilings are real numbers
            value = call(self.code, int, [value])
        return Value(WHOLE, value.text, known=None if value.kind == BITS else value.known)

    def _count(self, node: ast.For, first: Value, last: Value, step: Value, *, free: bool) -> None:
        code = self.code
        head, body, again, end = code.label(), code.label(), code.label(), code.label()
        place = code.place(WHOLE)
        code.write(place, first)
        code.jump(head)
        code.begin(head)
        now = code.read(place, WHOLE)
        code.fork(self._goes_on(now, last, step), body, end)
        code.begin(body)
        with code.independent(head) if free else nullcontext(code.rolled(head)) as back:
            self._give(node.target, now)
            self._loop(node.body, again, end)
            code.jump(again)
            code.begin(again)
            code.write(place, binary(code, ast.Add, code.read(place, WHOLE), step))
        code.do(back)
        code.begin(end)

    def _goes_on(self, now: Value, last: Value, step: Value) -> Value:
        code = self.code
        up = code.get("i1", f"icmp slt i64 {now.text}, {last.text}")
        if step.known is not None and step.known > 0:
            return up
        down = code.get("i1", f"icmp sgt i64 {now.text}, {last.text}")
        if step.known is not None:
            return down
        rising = code.get("i1", f"icmp sgt i64 {step.text}, 0")
        falling = code.get("i1", f"icmp slt i64 {step.text}, 0")
        back = code.get("i1", f"and i1 {falling.text}, {down.text}")
        return code.get("i1", f"select i1 {rising.text}, i1 {up.text}, i1 {back.text}")

    def _for_elements(self, node: ast.For, array: Value) -> None:
        if not isinstance(array.kind, Array) or not isinstance(node.target, ast.Name):
            raise EngineError(f"kernels loop over ranges and arrays, not {spelled(node.iter)}")
        code = self.code
        head, body, again, end = code.label(), code.label(), code.label(), code.label()
        place = code.place(WHOLE)
        code.write(place, constant(0))
        code.jump(head)
        code.begin(head)
        now = code.read(place, WHOLE)
        code.fork(code.get("i1", f"icmp slt i64 {now.text}, {array.sizes[0]}"), body, end)
        code.begin(body)
        code.store(node.target.id, code.element(array, [now]))
        self._loop(node.body, again, end)
        code.jump(again)
        code.begin(again)
        code.write(place, binary(code, ast.Add, code.read(place, WHOLE), constant(1)))
        code.jump(head)
        code.begin(end)


def _returns(tree: ast.FunctionDef) -> list[ast.Return]:
    return [node for node in ast.walk(tree) if isinstance(node, ast.Return)]


def _ends(body: list[ast.stmt]) -> bool:
    """Whether nothing comes after a body, because all ways through it return or go on forever."""
    last = body[-1]
    if isinstance(last, ast.If):
        return _ends(last.body) and bool(last.orelse) and _ends(last.orelse)
    if isinstance(last, ast.While):
        forever = isinstance(last.test, ast.Constant) and bool(last.test.value)
        return forever and not any(isinstance(node, ast.Break) for node in ast.walk(last))
    return isinstance(last, ast.Return)


def argument(name: str, kind: Kind) -> Value:
    """The value of an argument, the words of which are called after it."""
    if isinstance(kind, Array):
        sizes = tuple(f"%{name}.{axis}" for axis in range(1, kind.axes + 1))
        return Value(kind, f"%{name}.0", sizes)
    if isinstance(kind, Group):
        parts = [argument(f"{name}.{number}", part) for number, part in enumerate(kind.parts)]
        return Value(kind, parts=tuple(parts))
    return Value(kind, f"%{name}")


def returned(kind: Kind | None) -> str:
    """What LLVM calls the type of a result."""
    if kind is None:
        return "void"
    if isinstance(kind, str):
        return flat(kind)[0]
    return "{ " + ", ".join(flat(kind)) + " }"
