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

from gazelle.engines.planar.columns import NEAR, RATE, REACH, SLACK, START
from gazelle.engines.planar.compiled import kernel

TURN = 2.0 * math.pi
FEW = 48  # beams from which it pays to find out which ones are missed


@kernel
def angle_of(y, x):
    """atan2 to 1e-5 rad: Abramowitz and Stegun, Handbook of Mathematical Functions, 4.4.47."""
    ax, ay = abs(x), abs(y)
    q = min(ax, ay) / max(ax, ay)
    s = q * q
    a = q * (0.9998660 + s * (-0.3302995 + s * (0.1801410 + s * (-0.0851330 + s * 0.0208351))))
    a = 0.5 * math.pi - a if ay > ax else a
    a = math.pi - a if x < 0.0 else a
    return -a if y < 0.0 else a


@kernel
def draw_segment(beams, lo, hi, x0, y0, x1, y1, inverse, near, name):
    """Beams lo to hi, each of which may pass a segment on either side."""
    for k in range(np.uint64(lo), np.uint64(hi)):
        dx, dy, best, who = beams[0, k], beams[1, k], beams[2, k], beams[3, k]
        c0 = dx * y0 - dy * x0
        c1 = dx * y1 - dy * x1
        v = (c1 - c0) * inverse
        met = (c0 * c1 <= 0.0) & (v > best) & (v <= near)
        beams[2, k] = v if met else best
        beams[3, k] = name if met else who


@kernel
def draw_circle(beams, lo, hi, x, y, square, inverse, near, name):
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


@kernel
def draw_between(beams, lo, hi, circle, square, x0, y0, x1, y1, cross, near, name):
    """Beams lo to hi, which may meet a segment that is solid on its left, or a circle."""
    if circle:
        draw_circle(beams, lo, hi, x0, y0, square, 1.0 / cross, near, name)
    else:
        seen = name if cross < 0.0 else -name
        draw_segment(beams, lo, hi, x0, y0, x1, y1, 1.0 / cross, near, seen)


@kernel
def covered(circle, radius, x0, y0, x1, y1, cross):
    """The angles that a primitive covers: the first, and how many from there [rad]."""
    if not circle:
        first, last = angle_of(y0, x0), angle_of(y1, x1)
        if cross < 0.0:
            first, last = last, first
        return first, last - first if last >= first else last - first + TURN
    if cross <= 0.0:
        return 0.0, TURN
    half = angle_of(radius, math.sqrt(cross))
    return angle_of(y0, x0) - half, 2.0 * half


@kernel
def draw(beams, fan, circle, radius, x0, y0, x1, y1, name):
    """A segment that is solid on its left, or a circle about (x0, y0)."""
    square = radius * radius
    reach = fan[REACH]
    if circle:
        cross = x0 * x0 + y0 * y0 - square
        if cross > reach * (reach + 2.0 * radius):
            return
    else:
        cross = x0 * y1 - x1 * y0
        ex, ey = x1 - x0, y1 - y0
        if cross * cross > reach * reach * (ex * ex + ey * ey):
            return
    if cross == 0.0:
        return
    count = beams.shape[1]
    if count <= FEW:
        draw_between(beams, 0, count, circle, square, x0, y0, x1, y1, cross, fan[NEAR], name)
        return
    first, span = covered(circle, radius, x0, y0, x1, y1, cross)
    first -= fan[START] + fan[SLACK]
    first -= TURN * math.floor(first / TURN)
    span += 2.0 * fan[SLACK]
    for turn in range(-1, 2):
        angle = first + turn * TURN
        lo = int(max(math.ceil(angle * fan[RATE]), 0.0))
        hi = int(min(math.floor((angle + span) * fan[RATE]) + 1.0, float(count)))
        if lo < hi:
            draw_between(beams, lo, hi, circle, square, x0, y0, x1, y1, cross, fan[NEAR], name)
