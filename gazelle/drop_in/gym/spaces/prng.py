"""The source of random numbers that all spaces shared up to gym 0.10.

Spaces have sources of their own now: ``seed`` decides what is drawn here, not what they sample.
"""

from __future__ import annotations

import numpy as np

np_random = np.random.RandomState()


def seed(seed: int | None = None) -> None:
    """Set the seed of the random numbers."""
    np_random.seed(seed)
