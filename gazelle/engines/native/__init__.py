"""Machine code from the small part of Python that the engines' kernels are written in.

A kernel's source is turned into LLVM's intermediate language, function by function, with the
types of the arguments it is first called with; LLVM makes machine code of it, which is kept in
a cache (``store``) under a name that depends on all that it is made of.

Why an own compiler: the kernels need little of Python, and every process pays for the rest.
``gazelle bench kernels`` measures the pause at first use and what is left of it later;
``docs/planar.md`` has the figures. Only what a world needs is compiled, ahead if wanted.

The language: numbers, truth values and arrays as NumPy has them, tuples, loops over ranges and
arrays, conditions, calls of other such functions and of what ``calls`` lists. Anything else is
refused with its file, its line and what is meant. ``GAZELLE_INTERPRET_KERNELS=1`` has Python
run kernels instead, to the same bits, for debuggers and with checked indices.

What differs from Python, by design:

- Whole numbers have 64 bits and wrap around; divided by 0 they are 0. Shifts by 64 or more
  leave nothing but the sign, as in Python; by less than 0 they are taken as by 64 or more.
- Real numbers give infinity or NaN where Python raises an error. ``x ** 2`` is ``x * x``. Floors and
  ceilings are real. ``int`` of NaN is 0, of what is beyond 64 bits the nearest end. Beside a
  real number a whole one is made real before they are compared.
- A variable, and a result, has one kind: real if it is whole in one place and real in another.
- Arrays are contiguous, and indices are neither negative nor checked, as in C; slices neither.
  What is stored in smaller elements loses its upper bits. An array that a kernel makes in a
  loop is the same memory in each round; a variable without a value is 0.
"""

from gazelle.engines.native.calls import each, fetch_add, fused, lesser
from gazelle.engines.native.decorators import Function, inner, kernel, part, whole
from gazelle.engines.native.function import Native
from gazelle.engines.native.memory import call_c, floats, integers, long_at
from gazelle.engines.native.outside import c_function
from gazelle.engines.native.tape import Call, Tape

__all__ = [
    "Call", "Function", "Native", "Tape", "c_function", "call_c", "each", "fetch_add", "floats", "fused",
    "inner", "integers", "kernel", "lesser", "long_at", "part", "whole",
]  # fmt: skip
