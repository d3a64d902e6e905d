# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="no-any-return"
"""Blocks of work that threads take from each other."""

from __future__ import annotations

import cython

from gazelle.array_types import Ints64


def next_block(taken: Ints64) -> int:
    """Return the number of a block that no thread has taken.

    Args:
        taken: Number of blocks that were taken; the first of these numbers.
    """
    if cython.compiled:
        return gazelle_fetch_add(cython.address(taken[0]), 1)  # type: ignore[name-defined]  # noqa: F821
    taken[0] += 1
    return taken[0] - 1
