"""A function that runs as machine code."""

from __future__ import annotations

import ctypes
import functools
import hashlib
import threading
from collections.abc import Callable
from types import FunctionType
from typing import Any

from gazelle.engines.native.kinds import Kind
from gazelle.engines.native.library import digest_of, load
from gazelle.engines.native.machine import LOCK, machine
from gazelle.engines.native.memory import ENTRY
from gazelle.engines.native.packing import Words
from gazelle.errors import EngineError

Entry = tuple[Callable[[int], None], Kind | None]


class Native:
    """Compiles a function for the types it is called with, and calls it.

    It runs without the interpreter's lock.

    Args:
        function: What to compile, in the language of this package.
        inline: Whether it is always put into what calls it.
        whole: Whether other kernels call it as it is, so that it is compiled once; it returns
            nothing.
    """

    is_native = True

    def __init__(
        self, function: Callable[..., Any], *, inline: bool = False, whole: bool = False
    ) -> None:
        if not isinstance(function, FunctionType):
            raise TypeError("only functions can be compiled")
        self.function, self.inline, self.whole = function, inline, whole
        self.name = function.__name__
        functools.update_wrapper(self, function)
        self._own = threading.local()
        self._entries: dict[tuple[Kind, ...], Entry] = {}

    def __call__(self, *values: Any) -> Any:
        """Call it; what it returns."""
        own = self._own
        words: Words | None = getattr(own, "words", None)
        own.words = None  # where an error comes up, they may be half changed
        if words is None or not words.take(values):
            words = Words(values)
            own.call, own.result = self._entry(words.kinds)
        own.words = words
        own.call(words.address)
        return None if own.result is None else words.result(own.result)

    def entry(self, words: Words) -> int:
        """Where that is, compiled if need be, which takes the address of words of these kinds."""
        call, _ = self._entry(words.kinds)
        return int(ctypes.cast(call, ctypes.c_void_p).value or 0)  # type: ignore[arg-type]

    def symbol(self, kinds: tuple[Kind, ...]) -> str:
        """Its name in machine code for arguments of some kinds."""
        digest = hashlib.sha256(f"{self._digest}{kinds!r}".encode()).hexdigest()[:20]
        return f"{self.name}.{digest}"

    def address(self, kinds: tuple[Kind, ...]) -> int:
        """Where it is, compiled if need be, as a C function of values of some kinds.

        Raises:
            EngineError: It is not compiled as a whole.
        """
        if not self.whole:
            raise EngineError(f"only a kernel that is 'whole' has an address: {self.name}")
        self._entry(kinds)
        return machine().address(self.symbol(kinds))

    @functools.cached_property
    def _digest(self) -> str:
        return digest_of(self)  # when it is first called, all that it calls is there

    def _entry(self, kinds: tuple[Kind, ...]) -> Entry:
        """What calls it with words, compiled if need be, and what it returns."""
        with LOCK:
            if kinds not in self._entries:
                address, result = load(self, kinds)
                self._entries[kinds] = (ENTRY(address), result)
            return self._entries[kinds]
