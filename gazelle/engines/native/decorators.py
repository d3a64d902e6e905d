"""What kernels are marked with: native code, compiled on first use, kept for later runs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.engines.native.function import Native

Function = Callable[..., Any]


def kernel(function: Function) -> Function:
    """Compile a function to machine code that runs without the interpreter's lock.

    Kernels take ranges of worlds or bodies, so that any number of threads can share a task
    and none ever writes what another one reads; results do not depend on how it is shared.
    """
    return Native(function)


def whole(function: Function) -> Function:
    """Compile a kernel that other kernels call as it is; it is compiled once for all of them."""
    return Native(function, whole=True)


def part(function: Function) -> Function:
    """Compile a function that only kernels call; it becomes part of them."""
    return Native(function)


def inner(function: Function) -> Function:
    """Compile a function into the loop that calls it, where handing over arrays would cost most."""
    return Native(function, inline=True)
