"""The text of one function in LLVM's language while it grows: values, variables and blocks."""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from gazelle.engines.native.kinds import (
    BITS,
    ELEMENTS,
    REAL,
    TRUTH,
    UNSIGNED,
    WHOLE,
    WIDTH,
    Array,
    Group,
    Kind,
    Value,
    flat,
    joined,
    low,
)
from gazelle.errors import EngineError


class TypesChanged(Exception):  # noqa: N818  # no fault: the function is begun anew
    """A variable or result has turned out to need a wider type than was thought."""


def constant(known: Any) -> Value:
    """A number that is known.

    Raises:
        EngineError: It is none.
    """
    if isinstance(known, (bool, np.bool_)):
        return Value(TRUTH, "true" if known else "false", known=bool(known))
    if isinstance(known, np.uint64) or (isinstance(known, int) and 0 <= known >> 63 == 1):
        known = np.uint64(known)
        return Value(BITS, str(int(known)), known=known)
    if isinstance(known, (int, np.integer)):
        if not -(2 ** (WIDTH - 1)) <= known < 2 ** (WIDTH - 1):
            raise EngineError(f"{known} does not fit 64 bits")
        return Value(WHOLE, str(int(known)), known=int(known))
    if isinstance(known, (float, np.floating)):
        bits = struct.unpack("<Q", struct.pack("<d", float(known)))[0]
        return Value(REAL, f"0x{bits:016X}", known=float(known))
    raise EngineError(f"kernels know no constants like {known!r}")


class Code:
    """Lines of a function.

    Attributes:
        variables: Kind of each local variable, as far as it is known.
        result: Kind of what the function returns; None for nothing.
        declared: What it calls outside: a declaration for each name.
        notes: What is said about its loops.

    Args:
        numbers: Of notes.
    """

    def __init__(self, numbers: Iterator[int]) -> None:
        self._numbers = numbers
        self.variables: dict[str, Kind] = {}
        self.result: Kind | None = None
        self.declared: dict[str, str] = {}
        self.clear()

    def clear(self) -> None:
        """Begin anew, with what is known of types."""
        self._entry: list[str] = []
        self._lines: list[str] = []
        self._places: dict[str, list[str]] = {}
        self._count = 0
        self._group = ""
        self.notes: list[str] = []
        self.block = "begin"

    def body(self) -> str:
        """All blocks."""
        entry = "\n".join(self._entry)
        return "entry:\n" + entry + "\n  br label %begin\nbegin:\n" + "\n".join(self._lines)

    # -- lines ---------------------------------------------------------------------------

    def fresh(self) -> str:
        """A name that nothing has yet."""
        self._count += 1
        return f"%v{self._count}"

    def do(self, line: str) -> None:
        """Add a line that gives nothing."""
        self._lines.append("  " + line)

    def get(self, kind: Kind, line: str) -> Value:
        """Add a line that gives a number."""
        name = self.fresh()
        self._lines.append(f"  {name} = {line}")
        return Value(kind, name)

    def label(self) -> str:
        """Name of a new block."""
        self._count += 1
        return f"b{self._count}"

    def begin(self, label: str) -> None:
        """Go on in a block."""
        self._lines.append(f"{label}:")
        self.block = label

    def jump(self, label: str) -> None:
        """Go to a block."""
        self.do(f"br label %{label}")

    def fork(self, condition: Value, yes: str, no: str) -> None:
        """Go to one of two blocks."""
        self.do(f"br i1 {self.truth(condition).text}, label %{yes}, label %{no}")

    @contextmanager
    def independent(self, head: str) -> Iterator[str]:
        """Make the rounds of a loop that do not touch what others write; its way back."""
        outer, self._group = self._group, f"!{next(self._numbers)}"
        loop, access, one = (f"!{next(self._numbers)}" for _ in range(3))
        self.notes += [
            f"{self._group} = distinct !{{}}",
            f"{loop} = distinct !{{{loop}, {access}, {one}}}",
            f'{access} = !{{!"llvm.loop.parallel_accesses", {self._group}}}',
            f'{one} = !{{!"llvm.loop.interleave.count", i32 1}}',
        ]
        yield f"br label %{head}, !llvm.loop {loop}"
        self._group = outer

    def rolled(self, head: str) -> str:
        """The way back of a loop of which rounds are not put side by side unless all are known."""
        loop, no = (f"!{next(self._numbers)}" for _ in range(2))
        self.notes += [
            f"{loop} = distinct !{{{loop}, {no}}}",
            f'{no} = !{{!"llvm.loop.unroll.runtime.disable"}}',
        ]
        return f"br label %{head}, !llvm.loop {loop}"

    @property
    def mark(self) -> str:
        """What lines end with that read or write elements."""
        return f", !llvm.access.group {self._group}" if self._group else ""

    def gap(self) -> int:
        """Leave room for lines that are not known yet; where it is."""
        self._lines.append("")
        return len(self._lines) - 1

    def fill(self, gap: int, places: list[str], kind: Kind, value: Value) -> None:
        """Put a value into memory of a kind, in a gap."""
        lines, self._lines = self._lines, []
        self.write(places, self.turned(value, kind))
        lines[gap] = "\n".join(self._lines)
        self._lines = lines

    # -- variables -----------------------------------------------------------------------

    def place(self, kind: Kind) -> list[str]:
        """Memory for a value, from the beginning of the function on."""
        names = [self.fresh() for _ in flat(kind)]
        for name, each in zip(names, flat(kind), strict=True):
            self._entry.append(f"  {name} = alloca {each}")
        return names

    def room(self, element: str, sizes: list[int], *, zero: bool) -> Value:
        """An array of the function's own, as long as it runs."""
        name, kept = self.fresh(), ELEMENTS[element][0]
        kind = f"[{math.prod(sizes)} x {kept}]"
        self._entry.append(f"  {name} = alloca {kind}, align 64")
        if zero:
            self.do(f"store {kind} zeroinitializer, ptr {name}")
        return Value(Array(element, len(sizes)), name, tuple(map(str, sizes)))

    def store(self, name: str, value: Value) -> None:
        """Give a variable a value.

        Raises:
            TypesChanged: The variable needs a wider type.
        """
        before = self.variables.get(name, value.kind)
        kind = joined(before, value.kind)
        if kind is None:
            raise EngineError(f"'{name}' would be of two kinds: {before} and {value.kind}")
        known = name in self.variables
        self.variables[name] = kind
        if known and kind != before:
            raise TypesChanged
        if name not in self._places:
            self._places[name] = self.place(kind)
            for place, each in zip(self._places[name], flat(kind), strict=True):
                self._entry.append(f"  store {each} zeroinitializer, ptr {place}")
        self.write(self._places[name], self.turned(value, kind))

    def write(self, places: list[str], value: Value) -> None:
        """Put a value into memory of its kind."""
        for place, each, text in zip(places, flat(value.kind), words(value), strict=True):
            self.do(f"store {each} {text}, ptr {place}")

    def read(self, places: list[str], kind: Kind) -> Value:
        """What is in memory."""
        texts = [
            self.get(WHOLE, f"load {each}, ptr {place}").text
            for place, each in zip(places, flat(kind), strict=True)
        ]
        return rebuilt(kind, texts)

    def load(self, name: str) -> Value:
        """What a variable holds."""
        if name not in self._places:
            raise EngineError(f"'{name}' has no value yet")
        return self.read(self._places[name], self.variables[name])

    # -- numbers -------------------------------------------------------------------------

    def turned(self, value: Value, kind: Kind) -> Value:
        """A value as another kind that can hold it."""
        if value.kind == kind:
            return value
        if isinstance(kind, Group):
            parts = zip(value.parts, kind.parts, strict=True)
            return Value(kind, parts=tuple(self.turned(part, each) for part, each in parts))
        if kind == REAL:
            return self.real(value)
        if kind == WHOLE and value.kind == TRUTH:
            return self.get(WHOLE, f"zext i1 {value.text} to i64")
        raise EngineError(f"{value.kind} is not {kind}")

    def real(self, value: Value) -> Value:
        """A number as a real one."""
        if value.kind == REAL:
            return value
        if value.known is not None:
            return constant(float(value.known))
        how = {WHOLE: "sitofp i64", BITS: "uitofp i64", TRUTH: "uitofp i1"}
        if value.kind not in how:
            raise EngineError(f"{value.kind} is no number")
        return self.get(REAL, f"{how[str(value.kind)]} {value.text} to double")

    def truth(self, value: Value) -> Value:
        """Whether a number is not zero."""
        if value.kind == TRUTH:
            return value
        if value.kind == REAL:
            return self.get(TRUTH, f"fcmp une double {value.text}, 0.0")
        if value.kind not in (WHOLE, BITS):
            raise EngineError("only numbers are true or false")
        return self.get(TRUTH, f"icmp ne i64 {value.text}, 0")

    def whole(self, value: Value, kind: Kind = WHOLE) -> Value:
        """A real number as a whole one, towards zero; 0 of what is no number, else the ends."""
        name = f"llvm.fpto{'u' if kind == BITS else 's'}i.sat.i64.f64"
        self.declared[name] = f"declare i64 @{name}(double)"
        return self.get(kind, f"call i64 @{name}(double {value.text})")

    def index(self, value: Value) -> str:
        """A number as an index."""
        if value.kind not in (WHOLE, BITS, TRUTH):
            raise EngineError("an index must be a whole number; int(...) makes one")
        if isinstance(value.known, int) and value.known < 0:
            raise EngineError("an index must not be negative")
        return self.turned(value, WHOLE).text if value.kind == TRUTH else value.text

    # -- arrays --------------------------------------------------------------------------

    def address(self, array: Value, indices: list[Value]) -> str:
        """Of an element, or of the first one where there are fewer indices than axes."""
        if not isinstance(array.kind, Array) or len(indices) > array.kind.axes:
            raise EngineError("only arrays have elements, one index an axis")
        place = self.index(indices[0])
        for axis in range(1, array.kind.axes):
            place = self.get(WHOLE, f"mul nsw i64 {place}, {array.sizes[axis]}").text
            if axis < len(indices):
                step = self.index(indices[axis])
                place = self.get(WHOLE, f"add nsw i64 {place}, {step}").text
        kept = ELEMENTS[array.kind.element][0]
        line = f"getelementptr inbounds {kept}, ptr {array.text}, i64 {place}"
        return self.get(WHOLE, line).text

    def element(self, array: Value, indices: list[Value]) -> Value:
        """An element, or a part of an array with fewer axes."""
        address = self.address(array, indices)
        if not isinstance(array.kind, Array):
            raise EngineError("only arrays have elements")
        if len(indices) < array.kind.axes:
            kind = Array(array.kind.element, array.kind.axes - len(indices))
            return Value(kind, address, array.sizes[len(indices) :])
        kept, kind_ = ELEMENTS[array.kind.element]
        value = self.get(kind_, f"load {kept}, ptr {address}{self.mark}")
        if kept == "float":
            return self.get(REAL, f"fpext float {value.text} to double")
        if kind_ == TRUTH:
            return self.get(TRUTH, f"icmp ne i8 {value.text}, 0")
        if kept not in ("double", "i64"):
            how = "zext" if array.kind.element in UNSIGNED else "sext"
            return self.get(WHOLE, f"{how} {kept} {value.text} to i64")
        return value

    def put(self, array: Value, indices: list[Value], value: Value) -> None:
        """Write an element."""
        if not isinstance(array.kind, Array) or len(indices) != array.kind.axes:
            raise EngineError("one element is written at a time")
        address = self.address(array, indices)
        kept, kind = ELEMENTS[array.kind.element]
        if kind == TRUTH:
            truth = self.truth(value).text
            self.do(
                f"store i8 {self.get(WHOLE, f'zext i1 {truth} to i8').text}, ptr {address}{self.mark}"
            )
            return
        if kind != REAL and value.kind == REAL:
            value = self.whole(value, kind)
        elif kind == REAL or low(value.kind) != WHOLE:
            value = self.turned(value, kind)
        text = value.text
        if kept == "float":
            text = self.get(REAL, f"fptrunc double {text} to float").text
        elif kept not in ("double", "i64"):
            text = self.get(WHOLE, f"trunc i64 {text} to {kept}").text
        self.do(f"store {kept} {text}, ptr {address}{self.mark}")


def words(value: Value) -> list[str]:
    """What a value is handed over as; see ``kinds.flat``."""
    if isinstance(value.kind, Array):
        return [value.text, *value.sizes]
    if isinstance(value.kind, Group):
        return [text for part in value.parts for text in words(part)]
    return [value.text]


def rebuilt(kind: Kind, texts: list[str]) -> Value:
    """The value that was handed over as ``texts``."""
    if isinstance(kind, Array):
        return Value(kind, texts[0], tuple(texts[1:]))
    if isinstance(kind, Group):
        parts, at = [], 0
        for part in kind.parts:
            size = len(flat(part))
            parts.append(rebuilt(part, texts[at : at + size]))
            at += size
        return Value(kind, parts=tuple(parts))
    return Value(kind, texts[0])
