"""Compiled modules: the choice of their build, and shared parts.

A module that says ``import cython`` at its head is a kernel module: Cython in pure-Python mode.
It is compiled when the package is built, once for each *build* below, into a folder of that name
beside its source. A package with kernel modules has one line in its ``__init__``::

    __path__ = native.search_path(__path__)

so that ``import`` finds the compiled module first, under the name of its source. Which build is
used is decided once, for the whole process:

==========  ======================================================================================
`baseline`  any 64-bit processor; on x86 one of 2009 or newer (x86-64-v2)
`avx2`      x86 with AVX2; used where the processor and the system have it; the same bits
`checked`   indices and arguments are checked, also by the address and undefined-behaviour
            sanitizers; for tests (``make checked``)
`python`    nothing compiled: Python runs the sources, which a debugger can step through
==========  ======================================================================================

The environment variable ``GAZELLE_NATIVE`` names another one than the rule would choose.
"""

from pathlib import Path

from gazelle.native.builds import BUILD, search_path

__path__ = search_path([str(Path(__file__).parent)])

__all__ = ["BUILD", "search_path"]
