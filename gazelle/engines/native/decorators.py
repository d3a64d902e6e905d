"""What kernels are marked with: native code, compiled on first use, kept for later runs."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any, Final

from gazelle.engines.native.function import Native
from gazelle.engines.native.interpreter import interpreted

Function = Callable[..., Any]

_INTERPRET: Final = os.environ.get("GAZELLE_INTERPRET_KERNELS") == "1"


def kernel(function: Function) -> Function:
    """Compile a function to machine code that runs without the interpreter's lock.

    Kernels take ranges of worlds or bodies, so that any number of threads can share a task
    and none ever writes what another one reads; results do not depend on how it is shared.
    """
    return _made(Native(function))


def whole(function: Function) -> Function:
    """Compile a kernel that other kernels call as it is; it is compiled once for all of them."""
    return _made(Native(function, whole=True))


def part(function: Function) -> Function:
    """Compile a function that only kernels call; it becomes part of them."""
    return _made(Native(function))


def inner(function: Function) -> Function:
    """Compile a function into the loop that calls it, where handing over arrays would cost most."""
    return _made(Native(function, inline=True))


def _made(native: Native) -> Function:
    return interpreted(native.function) if _INTERPRET else native
