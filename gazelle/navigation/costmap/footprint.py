"""The outline of a robot."""

from __future__ import annotations

import ast
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats
from gazelle.errors import Error

_CORNERS = 16
"""Of the polygon in place of a circle, as costmap_2d has it."""


def footprint_of(text: object = "[]", radius: float = 0.46, padding: float = 0.01) -> Floats:
    """The corners of a robot, padded, shape (n, 2) [m].

    Args:
        text: A list of corners, or such a list as text; where it is empty the radius counts.
        radius: Of a round robot [m].
        padding: Added to each coordinate, away from the origin [m].

    Raises:
        Error: It is no list of three corners or more.
    """
    try:
        value = ast.literal_eval(text.strip() or "[]") if isinstance(text, str) else text
        corners = np.array(value, np.float64)
        if corners.size == 0:
            turns = 2.0 * math.pi * np.arange(_CORNERS) / _CORNERS
            corners = radius * np.stack((np.cos(turns), np.sin(turns)), axis=1)
    except (ValueError, SyntaxError, TypeError):
        corners = np.zeros(0)
    if (
        corners.ndim != 2
        or len(corners) < 3
        or corners.shape[1] != 2
        or not np.isfinite(corners).all()
    ):
        raise Error(
            f"a footprint is a list of three corners or more, not {str(text)[:80]!r}",
            hint="such as [[-0.1, -0.1], [-0.1, 0.1], [0.1, 0.1], [0.1, -0.1]]",
        )
    padded: Floats = corners + np.sign(corners) * padding
    return padded


def radii_of(footprint: Floats) -> tuple[float, float]:
    """The inscribed and the circumscribed radius about the origin [m]."""
    ends = np.roll(footprint, -1, axis=0)
    along = ends - footprint
    square = np.maximum((along**2).sum(axis=1), 1e-12)
    share = np.clip(-(footprint * along).sum(axis=1) / square, 0.0, 1.0)
    nearest = footprint + share[:, None] * along
    inner, outer = np.hypot(*nearest.T).min(), np.hypot(*footprint.T).max()
    return float(inner), float(outer)


def placed(footprint: Floats, x: float, y: float, heading: float) -> Floats:
    """The corners of a robot at a place, shape (n, 2)."""
    cos, sin = math.cos(heading), math.sin(heading)
    corners: Floats = footprint @ np.array([[cos, sin], [-sin, cos]]) + np.array([x, y])
    return corners


def inside(corners: Floats, x: NDArray[np.floating[Any]], y: NDArray[np.floating[Any]]) -> Bools:
    """Which points are within a polygon, by the even-odd rule; shape of ``x`` and ``y``."""
    found = np.zeros(np.broadcast(x, y).shape, np.bool_)
    for (ax, ay), (bx, by) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        if ay != by:
            crossing = ax + (y - ay) * (bx - ax) / (by - ay)
            found ^= ((ay <= y) != (by <= y)) & (x < crossing)
    return found
