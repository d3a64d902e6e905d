"""Array types for annotations, named by their content; shapes are in the docstrings."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle_ros.base.array_types import Bools as Bools  # noqa: PLC0414  # both are passed on
from gazelle_ros.base.array_types import Floats as Floats  # noqa: PLC0414
from gazelle_ros.base.array_types import Ints64 as Ints64  # noqa: PLC0414

Floats32 = NDArray[np.float32]
Bytes = NDArray[np.uint8]
Ints32 = NDArray[np.int32]
UInts64 = NDArray[np.uint64]

Indices = NDArray[np.intp]
"""Places in another array."""

Worlds = NDArray[np.intp]
"""Indices of worlds in a batch, shape (n,)."""

Picture = NDArray[np.uint8]
"""Red, green and blue of pixels, shape (height, width, 3)."""
