"""A path of straight segments with round corners, by its length.

Method: Kunz and Stilman, "Time-optimal trajectory generation for path following with bounded
acceleration and velocity", Robotics: Science and Systems VIII, 2012.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats

_STRAIGHT = 1e-6
_EQUAL = 1e-9


@dataclass(frozen=True, slots=True)
class PathPieces:
    """Straight segments and arcs, one after another.

    Attributes:
        begins: Start of each along the path, and the end of the last, shape (k + 1,).
        radii: Of arcs; infinite for straight segments, shape (k,).
        origins: Start of a straight segment, centre of an arc, shape (k, n).
        first: Direction of a straight segment; from the centre to an arc's start, shape (k, n).
        second: Direction in which an arc begins, shape (k, n).
    """

    begins: Floats
    radii: Floats
    origins: Floats
    first: Floats
    second: Floats

    @property
    def length(self) -> float:
        """Length of the whole path."""
        return float(self.begins[-1])

    def at(self, places: Floats) -> tuple[Floats, Floats, Floats]:
        """Return positions, and their first and second derivatives by the place.

        Each has shape (m, n).
        """
        index = np.searchsorted(self.begins, places, "right") - 1
        index = np.clip(index, 0, len(self.radii) - 1)
        along = (places - self.begins[index])[:, None]
        radius = self.radii[index][:, None]
        bent = np.isfinite(radius)
        safe = np.where(bent, radius, 1.0)
        angle = np.where(bent, along / safe, 0.0)
        x, y, origin = self.first[index], self.second[index], self.origins[index]
        cos, sin = np.cos(angle), np.sin(angle)
        turned = x * cos + y * sin
        position = origin + np.where(bent, safe * turned, x * along)
        slope = np.where(bent, y * cos - x * sin, x)
        bend = np.where(bent, -turned / safe, 0.0)
        return position, slope, bend


def blended(points: Floats, deviation: float) -> PathPieces:
    """Return a path through points, its corners rounded off.

    Args:
        points: Each another one than the last, shape (m, n), m at least 2.
        deviation: Largest deviation of the path at a corner.
    """
    pieces: list[tuple[float, float, Floats, Floats, Floats]] = []
    zero = np.zeros(points.shape[1])
    here = points[0]
    for number in range(1, len(points) - 1):
        arc = _arc(points[number - 1], points[number], points[number + 1], deviation)
        if arc is None:
            _add_line(pieces, here, points[number], zero)
            here = points[number]
            continue
        angle, radius, centre, x, y, end = arc
        _add_line(pieces, here, centre + radius * x, zero)
        pieces.append((radius * angle, radius, centre, x, y))
        here = end
    _add_line(pieces, here, points[-1], zero)
    begins = np.concatenate(([0.0], np.cumsum([piece[0] for piece in pieces])))
    return PathPieces(
        begins,
        np.array([piece[1] for piece in pieces]),
        np.array([piece[2] for piece in pieces]),
        np.array([piece[3] for piece in pieces]),
        np.array([piece[4] for piece in pieces]),
    )


def _add_line(
    pieces: list[tuple[float, float, Floats, Floats, Floats]],
    first: Floats,
    second: Floats,
    zero: Floats,
) -> None:
    length = float(np.linalg.norm(second - first))
    if length > _EQUAL:
        pieces.append((length, math.inf, first, (second - first) / length, zero))


def _arc(
    before: Floats, corner: Floats, after: Floats, deviation: float
) -> tuple[float, float, Floats, Floats, Floats, Floats] | None:
    """Return angle, radius, centre, axes and end of the arc at a corner.

    None if it is straight.
    """
    one, two = corner - before, after - corner
    length1, length2 = float(np.linalg.norm(one)), float(np.linalg.norm(two))
    one, two = one / length1, two / length2
    angle = math.acos(max(-1.0, min(1.0, float(one @ two))))
    if angle < _STRAIGHT or math.pi - angle < _STRAIGHT:
        return None
    half = angle / 2.0
    # From the corner to where the arc begins, so that its middle is near enough.
    distance = min(
        length1 / 2.0, length2 / 2.0, deviation * math.sin(half) / (1.0 - math.cos(half))
    )
    radius = distance / math.tan(half)
    inwards = two - one
    inwards = inwards / np.linalg.norm(inwards)
    centre = corner + inwards * (radius / math.cos(half))
    start = corner - distance * one
    return angle, radius, centre, (start - centre) / radius, one, corner + distance * two
