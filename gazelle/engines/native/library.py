"""Machine code of kernels: made when it is needed, kept for later runs, loaded once."""

from __future__ import annotations

import functools
import hashlib
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.engines.native import store
from gazelle.engines.native.kinds import Group, Kind
from gazelle.engines.native.machine import machine
from gazelle.engines.native.module import Module
from gazelle.errors import EngineError

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
    try:
        code = machine().compile(module.text())
    except RuntimeError as error:
        raise EngineError(
            f"the compiler fails at this kernel: {' '.join(str(error).split())}",
            file=native.function.__code__.co_filename, element=native.name,
        ) from error  # fmt: skip
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


def digest_of(native: Native) -> str:
    """A hash of all that a kernel's machine code depends on but types and processor."""
    parts: list[str] = [_compiler()]
    _describe(native, parts, set())
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def _describe(native: Native, parts: list[str], seen: set[int]) -> None:
    """What a kernel says, and what the names in it mean."""
    if id(native) in seen:
        return
    seen.add(id(native))
    function = native.function
    code = function.__code__
    constants = [each for each in code.co_consts if each != function.__doc__]
    parts.append(f"{code.co_name} {native.inline} {native.whole} {code.co_varnames} {constants}")
    parts.append(f"{code.co_names} {code.co_code.hex()}")
    for name in code.co_names:
        if name in function.__globals__:
            _mean(name, function.__globals__[name], code.co_names, parts, seen)


def _mean(name: str, value: Any, names: tuple[str, ...], parts: list[str], seen: set[int]) -> None:
    """What a name means, and what names mean that may be looked up in that."""
    if getattr(value, "is_native", False):
        _describe(value, parts, seen)
        return
    plain = isinstance(value, (bool, int, float)) or hasattr(value, "dtype")
    if plain or isinstance(value, tuple):
        parts.append(f"{name} = {value!r}")
    else:
        parts.append(f"{name} is {getattr(value, '__module__', '')}.{_title(value)}")
    for other in () if plain else names:
        if hasattr(value, other):
            others = tuple(each for each in names if each != other)
            _mean(f"{name}.{other}", getattr(value, other), others, parts, seen)


def _title(value: Any) -> str:
    return str(getattr(value, "__qualname__", type(value).__name__))


@functools.cache
def _compiler() -> str:
    """A hash of this package, and of the interpreter's version, on which bytecode depends."""
    files = sorted(Path(__file__).parent.glob("*.py"))
    texts = b"".join(file.read_bytes() for file in files)
    return hashlib.sha256(texts).hexdigest() + sys.version
