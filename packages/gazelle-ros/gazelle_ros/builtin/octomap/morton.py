"""Morton codes: keys of an octree's cells as numbers, in the order of the tree."""

from __future__ import annotations

import numpy as np

from gazelle_ros.base.array_types import Ints64

DEPTH = 16
"""Levels of the tree: keys have as many bits."""
ORIGIN = 1 << (DEPTH - 1)
"""Key of the cell that begins at 0."""
_STEPS = (
    (32, 0x001F00000000FFFF),
    (16, 0x001F0000FF0000FF),
    (8, 0x100F00F00F00F00F),
    (4, 0x10C30C30C30C30C3),
    (2, 0x1249249249249249),
)
_WHOLE = 0x1FFFFF


def encode(keys: Ints64) -> Ints64:
    """Return the codes of keys, shape (n,); x counts least.

    Args:
        keys: Along x, y and z, 0 to 65535, shape (n, 3).
    """
    wide = keys.astype(np.int64)
    for shift, mask in _STEPS:
        wide = (wide | wide << shift) & mask
    return wide[:, 0] | wide[:, 1] << 1 | wide[:, 2] << 2


def decode(codes: Ints64) -> Ints64:
    """Return the keys of codes, shape (n, 3)."""
    wide = np.stack((codes, codes >> 1, codes >> 2), axis=-1) & _STEPS[-1][1]
    masks = [mask for _, mask in _STEPS[-2::-1]] + [_WHOLE]
    for (shift, _), mask in zip(reversed(_STEPS), masks, strict=True):
        wide = (wide | wide >> shift) & mask
    return wide
