"""Number of threads for linear algebra, and precision of its matrix products.

Small networks gain nothing from a second thread, and threads that spin while
they wait take the core that the simulation needs: the same training run is
several times slower with two threads on two busy cores.
"""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterator

_VARIABLES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
_TURN = 1e-4  # [s]


def claim_environment(threads: int = 1) -> None:
    """Set the environment variables that BLAS libraries read when they are first loaded.

    Works only before numpy and torch are imported. What the user has set stays.

    Args:
        threads: Threads for each library.
    """
    for name in _VARIABLES:
        os.environ.setdefault(name, str(threads))


def limit_threads(threads: int = 1) -> None:
    """Limit torch and BLAS to some threads.

    Works at any time, also after numpy was imported.

    Args:
        threads: Threads for each library.
    """
    import torch
    from threadpoolctl import threadpool_limits

    torch.set_num_threads(threads)
    threadpool_limits(limits=threads, user_api="blas")


@contextlib.contextmanager
def products(*, bfloat16: bool) -> Iterator[None]:
    """Choose how torch multiplies matrices meanwhile.

    Args:
        bfloat16: Factors are rounded to bfloat16 where the processor can multiply that, and sums
            are of float32: small networks then learn in half the time.
    """
    import torch

    before = torch.get_float32_matmul_precision()
    torch.set_float32_matmul_precision("medium" if bfloat16 else "highest")
    try:
        yield
    finally:
        torch.set_float32_matmul_precision(before)


@contextlib.contextmanager
def short_turns(*, enabled: bool = True) -> Iterator[None]:
    """Shorten Python's thread switch interval while it lasts.

    One that needs the interpreter for some microseconds between two products waits up to 5 ms
    for another that works in Python; a tenth of a millisecond costs the other little.

    Args:
        enabled: False changes nothing.
    """
    before = sys.getswitchinterval()
    sys.setswitchinterval(min(before, _TURN) if enabled else before)
    try:
        yield
    finally:
        sys.setswitchinterval(before)


def multiplies_bfloat16() -> bool:
    """Return whether this processor multiplies bfloat16 faster than float32."""
    import torch

    able = torch.backends.mkldnn.is_available()  # type: ignore[no-untyped-call]  # of torch
    found = ("_is_avx512_bf16_supported", "_is_amx_tile_supported")
    return able and any(getattr(torch.cpu, name, lambda: False)() for name in found)
