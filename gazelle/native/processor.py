"""Capabilities of the processor."""

import cython

if not cython.compiled:

    def gazelle_has_avx2() -> int:
        """Return 0: sources run on any processor."""
        return 0


def has_avx2() -> bool:
    """Return whether it is an x86 with AVX2, and the system saves its wide registers."""
    return bool(gazelle_has_avx2())
