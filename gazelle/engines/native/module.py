"""A module in LLVM's language: a kernel for one set of types, and all that it calls."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gazelle.engines.native.code import Code, rebuilt, words
from gazelle.engines.native.kinds import RESULTS, Group, Kind, Value, flat
from gazelle.engines.native.source import tree_of
from gazelle.engines.native.statements import Statements, argument, returned
from gazelle.errors import EngineError

if TYPE_CHECKING:
    from gazelle.engines.native.function import Native


@dataclass(frozen=True, slots=True)
class Made:
    """A function of a module: its name there, and what it returns."""

    symbol: str
    result: Kind | None


class Module:
    """Collects functions.

    Attributes:
        outside: Kernels that are called but are in a module of their own, with the kinds of
            their arguments.
    """

    def __init__(self) -> None:
        self._texts: list[str] = []
        self._made: dict[tuple[Native, tuple[Kind, ...]], Made] = {}
        self._open: set[tuple[Native, tuple[Kind, ...]]] = set()
        self._declared: dict[str, str] = {}
        self._notes: list[str] = []
        self._numbers = itertools.count()
        self.outside: list[tuple[Native, tuple[Kind, ...]]] = []

    def text(self) -> str:
        """All of it."""
        return "\n".join([*self._texts, *self._declared.values(), *self._notes]) + "\n"

    def knows(self, callee: Any) -> bool:
        """Whether something is a kernel."""
        return getattr(callee, "is_native", False)

    def invoke(self, code: Code, callee: Native, values: list[Value]) -> Value:
        """A call of a kernel."""
        kinds = tuple(value.kind for value in values)
        made = self._elsewhere(code, callee, kinds) if callee.whole else self.add(callee, kinds)
        texts = [word for value in values for word in words(value)]
        typed = [f"{low} {text}" for low, text in zip(_flat(kinds), texts, strict=True)]
        low = returned(made.result)
        line = f"call {low} @{made.symbol}({', '.join(typed)}){code.mark}"
        if made.result is None:
            code.do(line)
            return Value("void")
        result = code.get(made.result, line)
        if isinstance(made.result, str):
            return result
        parts = [
            code.get(made.result, f"extractvalue {low} {result.text}, {place}").text
            for place in range(len(flat(made.result)))
        ]
        return rebuilt(made.result, parts)

    def add(self, native: Native, kinds: tuple[Kind, ...]) -> Made:
        """Make a function, if it is not made yet."""
        key = (native, kinds)
        if key in self._open:
            raise EngineError(f"kernels do not call themselves: {native.name}")
        if key not in self._made:
            self._open.add(key)
            symbol = f"f{len(self._made) + len(self._open)}.{native.name}"
            how = "alwaysinline" if native.inline else "nounwind"
            self._made[key] = self._define(native, kinds, symbol, "internal ", how)
            self._open.discard(key)
        return self._made[key]

    def add_whole(
        self, native: Native, kinds: tuple[Kind, ...], symbol: str, entry: str
    ) -> Kind | None:
        """Make a kernel, and what calls it with words; its result.

        Raises:
            EngineError: Its result is none that can be handed over.
        """
        self._open.add((native, kinds))
        # Calls with hundreds of words take LLVM long: only who else may call it has one.
        linkage, how = ("", "nounwind") if native.whole else ("internal ", "alwaysinline")
        made = self._define(native, kinds, symbol, linkage, how)
        _check_result(native, made.result)
        lines, texts = [], []
        for place, low in enumerate(_flat(kinds)):
            lines.append(f"  %p{place} = getelementptr i64, ptr %words, i64 {place}")
            lines.append(f"  %w{place} = load {low}, ptr %p{place}")
            texts.append(f"{low} %w{place}")
        low = returned(made.result)
        call = f"call {low} @{symbol}({', '.join(texts)})"
        lines.append(f"  {call}" if made.result is None else f"  %result = {call}")
        for place, each in enumerate([] if made.result is None else flat(made.result)):
            text = "%result"
            if not isinstance(made.result, str):
                text = f"%r{place}"
                lines.append(f"  {text} = extractvalue {low} %result, {place}")
            lines.append(f"  %o{place} = getelementptr i64, ptr %words, i64 {len(texts) + place}")
            lines.append(f"  store {each} {text}, ptr %o{place}")
        body = "\n".join(lines)
        self._texts.append(f"define void @{entry}(ptr %words) {{\n{body}\n  ret void\n}}")
        return made.result

    def _elsewhere(self, code: Code, callee: Native, kinds: tuple[Kind, ...]) -> Made:
        symbol = callee.symbol(kinds)
        if (callee, kinds) not in self.outside:
            self.outside.append((callee, kinds))
        code.declared[symbol] = f"declare void @{symbol}({', '.join(_flat(kinds))})"
        return Made(symbol, None)

    def _define(
        self, native: Native, kinds: tuple[Kind, ...], symbol: str, linkage: str, how: str
    ) -> Made:
        function = native.function
        file = function.__code__.co_filename
        tree = tree_of(function)
        maker = Statements(tree, list(kinds), function.__globals__, self, file, self._numbers)
        maker.make()
        code = maker.code
        names = [
            f"{low} {word}"
            for number, kind in enumerate(kinds)
            for low, word in zip(flat(kind), words(argument(f"a{number}", kind)), strict=True)
        ]
        head = f"define {linkage}{returned(code.result)} @{symbol}({', '.join(names)}) {how}"
        self._texts.append(f"{head} {{\n{code.body()}\n}}")
        self._declared.update(code.declared)
        self._notes += code.notes
        return Made(symbol, code.result)


def _flat(kinds: tuple[Kind, ...]) -> list[str]:
    return [low for kind in kinds for low in flat(kind)]


def _check_result(native: Native, result: Kind | None) -> None:
    """Refuse what words have no room for, and what C functions do not return.

    C gets the result of a kernel that is compiled on its own; other kernels do not.
    """
    parts = result.parts if isinstance(result, Group) else (result,)
    if native.whole and isinstance(result, Group):
        message = "a kernel that others call as it is returns one number at most"
    elif len(parts) > RESULTS or any(isinstance(part, Group) for part in parts):
        message = f"kernels hand at most {RESULTS} numbers to Python"
    else:
        return
    code = native.function.__code__
    raise EngineError(message, file=code.co_filename, line=code.co_firstlineno, element=native.name)
