"""Memory of C libraries at bare addresses, for kernels that those call.

Compiled modules take what ``memory.pxd`` says; this is the same for Python that runs sources.
"""

from __future__ import annotations

import ctypes
from typing import Any


def floats(address: int) -> Any:
    """Return the doubles from an address on; it can be indexed."""
    return ctypes.cast(address, ctypes.POINTER(ctypes.c_double))


def singles(address: int) -> Any:
    """Return the floats of 32 bits from an address on; it can be indexed."""
    return ctypes.cast(address, ctypes.POINTER(ctypes.c_float))


def integers(address: int) -> Any:
    """Return the C ints from an address on; it can be indexed."""
    return ctypes.cast(address, ctypes.POINTER(ctypes.c_int))


def longs(address: int) -> Any:
    """Return the integers of 64 bits from an address on; it can be indexed."""
    return ctypes.cast(address, ctypes.POINTER(ctypes.c_longlong))


def word(address: int) -> int:
    """Return the address, or the 64-bit integer, that is kept at an address."""
    return ctypes.c_size_t.from_address(address).value


def call_two(function: int, a: int, b: int) -> None:
    """Call a C function of two addresses."""
    ctypes.CFUNCTYPE(None, *[ctypes.c_size_t] * 2)(function)(a, b)


def call_four(function: int, a: int, b: int, c: int, d: int) -> None:
    """Call a C function of two addresses, an int and an address."""
    kinds = (ctypes.c_size_t, ctypes.c_size_t, ctypes.c_int, ctypes.c_size_t)
    ctypes.CFUNCTYPE(None, *kinds)(function)(a, b, c, d)


def call_five(function: int, a: int, b: int, c: int, d: int, e: int) -> None:
    """Call a C function of four addresses and an int."""
    ctypes.CFUNCTYPE(None, *[ctypes.c_size_t] * 4, ctypes.c_int)(function)(a, b, c, d, e)


def call_ray(
    function: int, a: int, b: int, c: int, d: int, e: int, f: int, g: int, h: int, i: int
) -> float:
    """Call a C function of five addresses, a byte, an int and two addresses; return a double."""
    address = ctypes.c_size_t
    kinds = (*[address] * 5, ctypes.c_uint8, ctypes.c_int, address, address)
    return float(ctypes.CFUNCTYPE(ctypes.c_double, *kinds)(function)(a, b, c, d, e, f, g, h, i))
