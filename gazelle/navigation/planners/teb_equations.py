"""Normal equations of a timed elastic band, in blocks: a residual depends on three poses in a row at most.

With three poses in a block they are block tridiagonal, so a solution takes time proportional to the
number of poses, and no matrix is large enough for BLAS to start threads.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from gazelle.array_types import Floats, Indices

STRIDE: Final = 3
"""Poses that a residual depends on, and poses in a block."""
_SIDE: Final = 4 * STRIDE


class BandEquations:
    """Gauss-Newton equations of the residuals of a band.

    Args:
        derivatives: Of each residual by x, y, heading and time of its poses, shape (n, 3, 4).
        first: The first pose of each residual, shape (n,).
        residuals: Their values, shape (n,).
        count: Number of poses.
    """

    def __init__(self, derivatives: Floats, first: Indices, residuals: Floats, count: int) -> None:
        self._count = count
        blocks = -(-count // STRIDE)
        block = first // STRIDE
        order = np.argsort(block, kind="stable")
        rows = np.bincount(block, minlength=blocks)
        within = np.arange(len(order)) - np.repeat(np.cumsum(rows) - rows, rows)
        # Residuals of a block reach into the next one.
        wide = np.zeros((blocks, int(rows.max()), 2 * STRIDE, 4))
        values = np.zeros((blocks, int(rows.max()), 1))
        block, place = block[order], (first % STRIDE)[order]
        for step in range(STRIDE):
            wide[block, within, place + step] = derivatives[order, step]
        values[block, within, 0] = residuals[order]
        jacobians = wide.reshape(blocks, -1, 2 * _SIDE)
        turned = jacobians.transpose(0, 2, 1)
        products, slopes = turned @ jacobians, (turned @ values)[:, :, 0]
        self._diagonal = products[:, :_SIDE, :_SIDE].copy()
        self._diagonal[1:] += products[:-1, _SIDE:, _SIDE:]
        self._above = products[:-1, :_SIDE, _SIDE:]
        self._slopes = slopes[:, :_SIDE].copy()
        self._slopes[1:] += slopes[:-1, _SIDE:]

    def step(self, damping: float) -> Floats:
        """Return the step against the slope, shape (count, 4).

        Args:
            damping: Added to the diagonal.
        """
        diagonal = self._diagonal + damping * np.eye(_SIDE)
        rest = -self._slopes
        blocks = len(diagonal)
        for block in range(1, blocks):
            above = self._above[block - 1]
            factor = np.linalg.solve(diagonal[block - 1], above).T
            diagonal[block] -= factor @ above
            rest[block] -= factor @ rest[block - 1]
        found = np.zeros_like(rest)
        for block in range(blocks - 1, -1, -1):
            if block + 1 < blocks:
                rest[block] -= self._above[block] @ found[block + 1]
            found[block] = np.linalg.solve(diagonal[block], rest[block])
        return found.reshape(-1, 4)[: self._count]
