"""Which rows of arrays are meant, and quaternions of length one."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats, Worlds


def rows_of(worlds: Worlds | None) -> slice | Worlds:
    """An index for these worlds, all if None."""
    return slice(None) if worlds is None else worlds


def unit(q: Floats) -> Floats:
    """Quaternions normalised; zero becomes the identity, as in Gazebo."""
    norm: Floats = np.sqrt(np.einsum("...i,...i->...", q, q))[..., None]
    if norm.all():
        return q / norm
    whole = np.where(norm > 0.0, q, (0.0, 0.0, 0.0, 1.0))
    return whole / np.where(norm > 0.0, norm, 1.0)
