"""Machine code from the small part of Python that the engines' kernels are written in.

A kernel's source is turned into LLVM's intermediate language, function by function, with the
types of the arguments it is first called with; LLVM makes machine code of it, which is kept in
a cache. The language: numbers, truth values and arrays as NumPy has them, loops over ranges,
conditions, calls of other such functions and of what ``calls`` lists. Arrays are contiguous, and
indices are neither negative nor checked, as in C.
"""

from gazelle.engines.native.calls import each, fused, lesser
from gazelle.engines.native.decorators import Function, inner, kernel, part, whole
from gazelle.engines.native.function import Native
from gazelle.engines.native.memory import floats, integers, long_at
from gazelle.engines.native.outside import c_function

__all__ = [
    "Function", "Native", "c_function", "each", "floats", "fused", "inner", "integers", "kernel",
    "lesser", "long_at", "part", "whole",
]  # fmt: skip
