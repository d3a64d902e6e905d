"""Native kernels: compiled by Numba on first use, kept in its cache for later runs."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import Any, cast

from gazelle.errors import MissingExtraError

try:
    import numba
except ImportError as error:
    raise MissingExtraError("numba", "planar") from error

Function = Callable[..., Any]


def kernel(function: Function) -> Function:
    """Compile a function to machine code that runs without the interpreter's lock.

    Kernels take ranges of worlds or bodies, so that any number of threads can share a task
    and none ever writes what another one reads; results do not depend on how it is shared.
    """
    made = numba.njit(cache=True, nogil=True, error_model="numpy")(function)
    _follow_all_sources(made)
    return cast("Function", made)


def part(function: Function) -> Function:
    """Compile a function that only kernels call; it becomes part of them."""
    made = numba.njit(
        nogil=True, error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True
    )(function)
    return cast("Function", made)


def inner(function: Function) -> Function:
    """Compile a function into the loop that calls it, where handing over arrays would cost most."""
    made = numba.njit(
        nogil=True,
        error_model="numpy",
        no_cpython_wrapper=True,
        no_cfunc_wrapper=True,
        forceinline=True,
    )(function)
    return cast("Function", made)


def _follow_all_sources(made: Any) -> None:
    """Let the cache of one kernel also depend on the kernels that it calls.

    Numba looks only at the file a kernel is in, but what it keeps holds the code of others.
    """
    file = getattr(getattr(made, "_cache", None), "_cache_file", None)
    if file is not None and hasattr(file, "_source_stamp"):
        file._source_stamp = (file._source_stamp, _digest())  # noqa: SLF001  # see above


@lru_cache(maxsize=1)
def _digest() -> str:
    folder = Path(__file__).parent
    files = [folder / "columns.py", *sorted(folder.glob("kernels_*.py"))]
    texts = [path.read_bytes() for path in files]
    return hashlib.sha256(b"".join(texts)).hexdigest()
