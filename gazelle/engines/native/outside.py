"""Kernels that other programs call."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any

from gazelle.engines.native.function import Native
from gazelle.engines.native.kinds import WHOLE


def c_function(kernel: Callable[..., None], count: int) -> Any:
    """A kernel as a C function that takes addresses and returns nothing.

    It keeps the kernel alive, and must itself live as long as it may be called.

    Args:
        kernel: To call; compiled as a whole.
        count: How many addresses it takes.

    Returns:
        A function of ``ctypes``; it is called without the interpreter's lock.
    """
    made = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * count)
    return made(kernel.address((WHOLE,) * count) if isinstance(kernel, Native) else kernel)
