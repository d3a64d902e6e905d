"""Array types for annotations, named by their content; shapes are in the docstrings."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Ints64 = NDArray[np.int64]

Pixels = NDArray[Any]
"""An image, shape (height, width) or (height, width, channels)."""
