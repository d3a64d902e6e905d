"""Machine code of kernels: made when it is needed, kept for later runs, loaded once."""

from __future__ import annotations

import functools
import hashlib
import sys
from pathlib import Path
from types import FunctionType
from typing import TYPE_CHECKING, Any

from gazelle.engines.native import store
from gazelle.engines.native.kinds import Group, Kind
from gazelle.engines.native.machine import machine
from gazelle.engines.native.module import Module

if TYPE_CHECKING:
    from gazelle.engines.native.function import Native

_results: dict[str, Kind | None] = {}  # of what is loaded


def load(native: Native, kinds: tuple[Kind, ...]) -> tuple[int, Kind | None]:
    """Compile and load a kernel if need be; the address of what calls it, and what it returns."""
    symbol = native.symbol(kinds)
    if symbol not in _results and not _load_kept(symbol):
        _compile(native, kinds)
    return machine().address(f"{symbol}.entry"), _results[symbol]


def _compile(native: Native, kinds: tuple[Kind, ...]) -> None:
    symbol, module = native.symbol(kinds), Module()
    result = module.add_whole(native, kinds, symbol, f"{symbol}.entry")
    for other, its in module.outside:
        load(other, its)
    code = machine().compile(module.text())
    needs = [other.symbol(its) for other, its in module.outside]
    head = " ".join([_spelled(result), *needs]) + "\n"
    store.write(_key(symbol), head.encode() + code)
    machine().load(code)
    _results[symbol] = result


def _load_kept(symbol: str) -> bool:
    """Load a kernel, and what it calls, from the cache; False if something is not there."""
    kept = store.read(_key(symbol))
    if kept is None:
        return False
    head, _, code = kept.partition(b"\n")
    result, *needs = head.decode().split(" ")
    if not all(need in _results or _load_kept(need) for need in needs):
        return False
    machine().load(code)
    _results[symbol] = _read(result)
    return True


def _key(symbol: str) -> str:
    return hashlib.sha256(f"{symbol}\n{machine().name}".encode()).hexdigest()[:40]


def _spelled(result: Kind | None) -> str:
    if isinstance(result, Group):
        return "(" + ",".join(str(part) for part in result.parts)
    return "-" if result is None else str(result)


def _read(text: str) -> Kind | None:
    if text.startswith("("):
        return Group(tuple(text[1:].split(",")))
    return None if text == "-" else text


def digest_of(function: FunctionType) -> str:
    """A hash of all that a function's machine code depends on but types and processor."""
    parts: list[str] = [_compiler()]
    seen: set[FunctionType] = set()
    _describe(function, parts, seen)
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def _describe(function: FunctionType, parts: list[str], seen: set[FunctionType]) -> None:
    if function in seen:
        return
    seen.add(function)
    code = function.__code__
    parts.append(f"{code.co_name} {code.co_varnames} {code.co_names} {code.co_consts[1:]}")
    parts.append(code.co_code.hex())
    for name in code.co_names:
        value: Any = function.__globals__.get(name)
        if getattr(value, "is_native", False):
            _describe(value.function, parts, seen)
        elif isinstance(value, (bool, int, float, tuple)) or hasattr(value, "dtype"):
            parts.append(f"{name} = {value!r}")


@functools.cache
def _compiler() -> str:
    """A hash of this package, and of the interpreter's version, on which bytecode depends."""
    files = sorted(Path(__file__).parent.glob("*.py"))
    texts = b"".join(file.read_bytes() for file in files)
    return hashlib.sha256(texts).hexdigest() + sys.version
