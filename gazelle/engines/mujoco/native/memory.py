"""Arrays at bare addresses, for code that Numba compiles."""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
from numba.core import cgutils, types
from numba.extending import intrinsic


@intrinsic  # type: ignore[untyped-decorator]
def _pointer(_context: Any, _address: Any) -> Any:
    """The pointer that a number stands for."""

    def generate(_: Any, builder: Any, __: Any, arguments: Any) -> Any:
        return builder.inttoptr(arguments[0], cgutils.voidptr_t)

    return types.voidptr(types.int64), generate


@numba.njit(inline="always")  # type: ignore[untyped-decorator]
def floats(address: int, count: int) -> Any:
    """So many doubles at an address."""
    return numba.carray(_pointer(address), (count,), np.float64)


@numba.njit(inline="always")  # type: ignore[untyped-decorator]
def integers(address: int, count: int) -> Any:
    """So many 32-bit integers at an address."""
    return numba.carray(_pointer(address), (count,), np.int32)


@numba.njit(inline="always")  # type: ignore[untyped-decorator]
def long_at(address: int) -> Any:
    """The 64-bit integer at an address, or the address kept there."""
    return numba.carray(_pointer(address), (1,), np.int64)[0]
