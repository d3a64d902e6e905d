"""Ends of openai_ros' CartPoleStayUp, on arrays of what is observed."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Bools, Floats, Floats32

Range = tuple[float, float]
PLACES, ANGLES = (-1.0, 1.0), (-0.7, 0.7)
"""Places of the cart [m] and angles of the pole [rad] at which an episode ends, as published."""


def has_fallen(seen: Floats | Floats32, places: Range = PLACES, angles: Range = ANGLES) -> Bools:
    """Return whether the episode ends, of observations, shape (n, 4): one at a bound does."""
    place, angle = seen[:, 0], seen[:, 2]
    off = (place <= places[0]) | (place >= places[1])
    return np.asarray(off | (angle <= angles[0]) | (angle >= angles[1]), np.bool_)
