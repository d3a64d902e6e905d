"""The outline of a robot."""

from __future__ import annotations

import ast
import math

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Indices
from gazelle.errors import Error

_CORNERS = 16
"""Of the polygon in place of a circle, as costmap_2d has it."""


@checked(Error, after=True)
def footprint_of(text: object = "[]", radius: float = 0.46, padding: float = 0.01) -> Floats:
    """Return the corners of a robot, padded, shape (n, 2) [m].

    Args:
        text: A list of corners, or such a list as text; where it is empty the radius counts.
        radius: Of a round robot [m].
        padding: Added to each coordinate, away from the origin [m].

    Raises:
        Error: It is not a list of three corners or more.
    """
    try:
        value = ast.literal_eval(text.strip() or "[]") if isinstance(text, str) else text
        corners = np.array(value, np.float64)
        if corners.size == 0:
            turns = 2.0 * math.pi * np.arange(_CORNERS) / _CORNERS
            corners = radius * np.stack((np.cos(turns), np.sin(turns)), axis=1)
        corners = corners + np.sign(corners) * padding
    except (ValueError, SyntaxError, TypeError):
        corners = np.zeros(0)
    if (
        corners.ndim != 2
        or len(corners) < 3
        or corners.shape[1] != 2
        or not np.isfinite(corners).all()
    ):
        raise Error(
            f"a footprint must be a list of three corners or more, not {str(text)[:80]!r}",
            hint="such as [[-0.1, -0.1], [-0.1, 0.1], [0.1, 0.1], [0.1, -0.1]]",
        )
    return corners


def radii_of(footprint: Floats) -> tuple[float, float]:
    """Return the inscribed and the circumscribed radius about the origin [m]."""
    ends = np.roll(footprint, -1, axis=0)
    along = ends - footprint
    square = np.maximum((along**2).sum(axis=1), 1e-12)
    share = np.clip(-(footprint * along).sum(axis=1) / square, 0.0, 1.0)
    nearest = footprint + share[:, None] * along
    inner, outer = np.hypot(*nearest.T).min(), np.hypot(*footprint.T).max()
    return float(inner), float(outer)


def placed(footprint: Floats, x: float, y: float, heading: float) -> Floats:
    """Return the corners of a robot at a place, shape (n, 2)."""
    cos, sin = math.cos(heading), math.sin(heading)
    corners: Floats = footprint @ np.array([[cos, sin], [-sin, cos]]) + np.array([x, y])
    return corners


def cells_under(corners: Indices) -> tuple[Indices, Indices]:
    """Return the cells that a robot is on, those of its outline included.

    The lines from corner to corner are those along which local planners look for obstacles, so that
    a robot never stands on an obstacle in a costmap where these cells were freed.

    Args:
        corners: Columns and rows of the corners of a convex outline, shape (n, 2).

    Returns:
        Columns and rows, shape (k,) each.
    """
    lines = [_line(*ends) for ends in zip(corners, np.roll(corners, -1, axis=0), strict=True)]
    columns, rows = np.concatenate(lines).T
    first = int(columns.min())
    count = int(columns.max()) - first + 1
    low, high = np.full(count, rows.max()), np.full(count, rows.min())
    np.minimum.at(low, columns - first, rows)
    np.maximum.at(high, columns - first, rows)
    heights = high - low + 1
    which = np.repeat(np.arange(count), heights)
    above = np.arange(len(which)) - np.repeat(np.cumsum(heights) - heights, heights)
    return first + which, low[which] + above


def _line(start: Indices, end: Indices) -> Indices:
    """Return the cells of Bresenham's line as base_local_planner draws it, shape (k, 2)."""
    along = np.abs(end - start)
    count = int(along.max())
    if count == 0:
        return start[None]
    steps = np.arange(count + 1)[:, None]
    found: Indices = start + np.sign(end - start) * ((count // 2 + steps * along) // count)
    return found
