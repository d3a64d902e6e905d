# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="no-any-return"
"""Range and order of indices, found in one pass."""

from __future__ import annotations

import cython

from gazelle.array_types import Indices


def order_of(indices: Indices, count: int) -> int:
    """Return 0 if one of some indices, shape (n,), is not in range(count), else 2 if they rise, or 1."""
    before: cython.Py_ssize_t = -1
    order: cython.int = 2
    for i in range(indices.shape[0]):
        index = indices[i]
        if index < 0 or index >= count:
            return 0
        if index <= before:
            order = 1
        before = index
    return order
