"""Draw primitives into the beams of a fan, as a depth buffer with one row.

Everything is in the frame of the sensor. Rows of ``beams``: directions along x and y, one over
the distance to the nearest primitive met so far, and the name of that primitive. One over
a distance because the distance to a line, 1 / (a dx - b dy), then needs no division. Only beams
within the angles that a primitive covers are tested. Distances are exact; angles only choose
which beams are certainly missed.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.engines.native import part
from gazelle.engines.planar.columns import NEAR, RATE, SLACK, START
from gazelle.engines.planar.tables import Floats

TURN = 2.0 * math.pi
FEW = 48  # beams from which it pays to find out which ones are missed


@part
def angle_of(y: float, x: float) -> float:
    """atan2 to 1e-5 rad: Abramowitz and Stegun, Handbook of Mathematical Functions, 4.4.47."""
    ax, ay = abs(x), abs(y)
    q = min(ax, ay) / max(ax, ay, 1e-300)
    s = q * q
    a = q * (0.9998660 + s * (-0.3302995 + s * (0.1801410 + s * (-0.0851330 + s * 0.0208351))))
    a = 0.5 * math.pi - a if ay > ax else a
    a = math.pi - a if x < 0.0 else a
    return -a if y < 0.0 else a


@part
def draw_segment(
    beams: Floats, lo: int, hi: int, x0: float, y0: float, x1: float, y1: float, inverse: float,
    near: float, name: float,
) -> None:  # fmt: skip
    """Beams lo to hi, each of which may pass a segment on either side."""
    for k in range(np.uint64(lo), np.uint64(hi)):
        dx, dy, best, who = beams[0, k], beams[1, k], beams[2, k], beams[3, k]
        c0 = dx * y0 - dy * x0
        c1 = dx * y1 - dy * x1
        v = (c1 - c0) * inverse
        met = (c0 * c1 <= 0.0) & (v > best) & (v <= near)
        beams[2, k] = v if met else best
        beams[3, k] = name if met else who


@part
def draw_circle(
    beams: Floats, lo: int, hi: int, x: float, y: float, square: float, inverse: float,
    near: float, name: float,
) -> None:  # fmt: skip
    """Beams lo to hi, each of which may pass a circle; what they meet from inside is negative."""
    for k in range(np.uint64(lo), np.uint64(hi)):
        dx, dy, best, who = beams[0, k], beams[1, k], beams[2, k], beams[3, k]
        along = dx * x + dy * y
        aside = dx * y - dy * x
        rest = square - aside * aside
        root = math.sqrt(max(rest, 0.0))
        front, back = (along + root) * inverse, (along - root) * inverse
        facing = (front > 0.0) & (front <= near)
        v = front if facing else back
        met = (rest >= 0.0) & (v > best) & (v <= near)
        seen = name if facing else -name
        beams[2, k] = v if met else best
        beams[3, k] = seen if met else who


@part
def draw(beams: Floats, lo: int, hi: int, fan: Floats, found: Floats, i: int) -> None:
    """Beams lo to hi, which may meet the i-th segment or disc found."""
    x0, y0, radius = found[0, i], found[1, i], found[4, i]
    if radius > 0.0:
        square = radius * radius
        draw_circle(beams, lo, hi, x0, y0, square, found[8, i], fan[NEAR], found[7, i])
    else:
        x1, y1 = found[2, i], found[3, i]
        draw_segment(beams, lo, hi, x0, y0, x1, y1, found[8, i], fan[NEAR], found[7, i])


@part
def draw_through(beams: Floats, found: Floats, number: int, near: float) -> None:
    """All beams, each of which may meet any of a ``number`` of segments and discs found.

    The same as ``draw`` for each of them, in one loop for speed where beams are few.
    """
    for i in range(np.uint64(number)):
        x0, y0, x1, y1, radius = found[0, i], found[1, i], found[2, i], found[3, i], found[4, i]
        name, inverse = found[7, i], found[8, i]
        if radius > 0.0:
            square = radius * radius
            for k in range(np.uint64(beams.shape[1])):
                dx, dy, best, who = beams[0, k], beams[1, k], beams[2, k], beams[3, k]
                along = dx * x0 + dy * y0
                aside = dx * y0 - dy * x0
                rest = square - aside * aside
                root = math.sqrt(max(rest, 0.0))
                front, back = (along + root) * inverse, (along - root) * inverse
                facing = (front > 0.0) & (front <= near)
                v = front if facing else back
                met = (rest >= 0.0) & (v > best) & (v <= near)
                beams[2, k] = v if met else best
                beams[3, k] = (name if facing else -name) if met else who
        else:
            for k in range(np.uint64(beams.shape[1])):
                dx, dy, best, who = beams[0, k], beams[1, k], beams[2, k], beams[3, k]
                c0 = dx * y0 - dy * x0
                c1 = dx * y1 - dy * x1
                v = (c1 - c0) * inverse
                met = (c0 * c1 <= 0.0) & (v > best) & (v <= near)
                beams[2, k] = v if met else best
                beams[3, k] = name if met else who


@part
def solve(found: Floats, number: int) -> None:
    """Prepare what was found for drawing: what distances are shares of, and names by side.

    A segment is solid on its left: who sees it from there sees it from inside.
    """
    for i in range(np.uint64(number)):
        x0, y0, x1, y1, radius = found[0, i], found[1, i], found[2, i], found[3, i], found[4, i]
        name = found[7, i]
        disc = radius > 0.0
        cross = x0 * x0 + y0 * y0 - radius * radius if disc else x0 * y1 - x1 * y0
        found[8, i] = 0.0 if cross == 0.0 else 1.0 / cross
        found[7, i] = name if disc | (cross < 0.0) else -name


@part
def cover(found: Floats, number: int, fan: Floats) -> None:
    """Find the angles that segments and discs cover, many at once.

    Args:
        found: Rows of a ``number`` of them: x and y of one end or the middle, x and y of
            the other end, the radius, 0 for a segment; what comes out are the first angle
            from that of the first beam, less what it may be wrong by, and how many from there.
        number: How many.
        fan: The fan.
    """
    for i in range(np.uint64(number)):
        x0, y0, x1, y1, radius = found[0, i], found[1, i], found[2, i], found[3, i], found[4, i]
        disc = radius > 0.0
        outside = x0 * x0 + y0 * y0 - radius * radius
        half = angle_of(radius, math.sqrt(max(outside, 1e-300)))
        first, other = angle_of(y0, x0), angle_of(y1, x1)
        left = x0 * y1 - x1 * y0 > 0.0
        start = first if left else other
        span = (other if left else first) - start
        span = span + TURN if span < 0.0 else span
        start = first - half if disc else start
        span = 2.0 * half if disc else span
        span = TURN if disc & (outside <= 0.0) else span
        start -= fan[START] + fan[SLACK]
        found[5, i] = start - TURN * math.floor(start / TURN)
        found[6, i] = span + 2.0 * fan[SLACK]


@part
def beams_in(fan: Floats, count: int, first: float, span: float, turn: int) -> tuple[int, int]:
    """The beams among angles found by ``cover``, from the first to before the last.

    ``turn`` is 0, -1 and 1: a fan may go once around.
    """
    first += TURN * turn
    lo = math.ceil(first * fan[RATE])
    hi = math.floor((first + span) * fan[RATE]) + 1.0
    if hi <= 0.0 or lo >= count:
        return 0, 0
    return int(max(lo, 0.0)), int(min(hi, float(count)))
