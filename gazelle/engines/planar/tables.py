"""Types of the arrays that kernels work on."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float64]
Cells: TypeAlias = NDArray[np.int32]
Indices: TypeAlias = NDArray[np.int64]
Marks: TypeAlias = NDArray[np.int8]
Flags: TypeAlias = NDArray[np.bool_]
