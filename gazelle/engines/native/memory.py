"""Arrays at bare addresses, for kernels that other programs call with addresses of their own."""

from __future__ import annotations

import ctypes

import numpy as np
from numpy.typing import NDArray

ENTRY = ctypes.CFUNCTYPE(None, ctypes.c_void_p)
"""What Python calls of a kernel: it takes the address of its words."""


def floats(address: int, count: int) -> NDArray[np.float64]:
    """So many doubles at an address."""
    return np.ctypeslib.as_array((ctypes.c_double * count).from_address(address))


def integers(address: int, count: int) -> NDArray[np.int32]:
    """So many 32-bit integers at an address."""
    return np.ctypeslib.as_array((ctypes.c_int32 * count).from_address(address))


def long_at(address: int) -> int:
    """The 64-bit integer at an address, or the address kept there."""
    return ctypes.c_int64.from_address(address).value


def call_c(function: int, *words: int) -> None:
    """Call a C function at an address with whole numbers or addresses; what it gives is lost."""
    ctypes.CFUNCTYPE(None, *[ctypes.c_int64] * len(words))(function)(*words)


def call_at(function: int, words: int) -> None:
    """Call the entry of a kernel with words, both at an address."""
    ENTRY(function)(words)
