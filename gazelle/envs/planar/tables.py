"""Types of the arrays that kernels of tasks work on, and what their columns mean."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]
Worlds = NDArray[np.intp]
Indices = NDArray[np.int64]
Table = Any  # what the planar engine's kernels take; only compiled code reads it

# A path that a body follows: its body, the first and last of its way-points, whether it goes
# round, how fast it turns about z [rad/s], where it starts: x, y, z [m] and heading [rad], and
# how far a point of it goes in a control step at most [m].
PATH_BODY: Final = 0
PATH_FIRST: Final = 1
PATH_LAST: Final = 2
PATH_LOOP: Final = 3
PATH_SPIN: Final = 4
PATH_START: Final = 5
PATH_DRIFT: Final = 9
PATH: Final = 10

# A drive of two wheels: body, half the distance of the wheels [m], their radius [m], how fast
# they change their speed [m/s²], radius of the whole body [m].
LAW_BODY: Final = 0
LAW_HALF: Final = 1
LAW_RADIUS: Final = 2
LAW_RAMP: Final = 3
LAW_REACH: Final = 4
LAW: Final = 5
