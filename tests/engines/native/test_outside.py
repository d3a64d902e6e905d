"""Kernels that C functions call, and that call C functions."""

import ctypes

import numpy as np

from gazelle.engines.native import c_function, call_c, floats, kernel, whole


@whole
def add(first: int, second: int, count: int) -> None:
    """Add the second numbers to the first, which are at addresses."""
    one, other = floats(first, count), floats(second, count)
    for i in range(count):
        one[i] += other[i]


@kernel
def call_it(function: int, first: int, second: int, count: int, times: int) -> None:
    """Call a C function so often."""
    for _ in range(times):
        call_c(function, first, second, count)


def test_a_kernel_calls_a_function_at_an_address():
    function = c_function(add, 3)
    place = ctypes.cast(function, ctypes.c_void_p).value
    first, second = np.arange(4.0), np.array([1.0, 10.0, 100.0, 1000.0])
    call_it(place, first.ctypes.data, second.ctypes.data, 3, 5)
    assert first.tolist() == [5.0, 51.0, 502.0, 3.0]


def test_so_does_python_where_it_runs_kernels():
    seen = []
    function = ctypes.CFUNCTYPE(None, ctypes.c_int64, ctypes.c_int64)(
        lambda one, other: seen.append((one, other))
    )
    call_c(ctypes.cast(function, ctypes.c_void_p).value, 3, -(2**40))
    assert seen == [(3, -(2**40))]
