"""Velocity of a frame, from two of its placements."""

from __future__ import annotations

import math

from gazelle_ros.base.rotations import Vector, add, conjugate, minus, multiply, rotate
from gazelle_ros.tf.core import FrameTree

_SECOND = 1e-9
_FIRST_NS = 10_000
"""No look-up is made at time 0, which means the latest."""


def twist(
    tree: FrameTree,
    tracked: str,
    observer: str,
    *,
    reference: str,
    point: Vector,
    point_frame: str,
    stamp: int,
    interval: int,
) -> tuple[Vector, Vector]:
    """Return linear [m/s] and angular [rad/s] velocity of a frame, averaged over an interval.

    Args:
        tree: The frames.
        tracked: The frame that moves.
        observer: The frame it moves against.
        reference: The frame of the result's axes.
        point: Point of the velocity [m].
        point_frame: The frame of `point`.
        stamp: In the middle of the interval [ns], 0 for the latest.
        interval: Interval [ns].

    Raises:
        TransformException: There is no transform; its class says why.
    """
    latest = tree.latest_common_time(observer, tracked)
    middle = stamp or latest
    end = min(middle + interval // 2, latest)
    start = max(_FIRST_NS + interval, end) - interval
    length = (end - start) * _SECOND
    first, last = tree.lookup(observer, tracked, start), tree.lookup(observer, tracked, end)
    moved = add(last.translation, minus(first.translation))
    linear = (moved[0] / length, moved[1] / length, moved[2] / length)
    x, y, z, w = multiply(conjugate(first.rotation), last.rotation)
    sine = math.sqrt(x * x + y * y + z * z)
    rate = 2.0 * math.atan2(sine, w) / length / sine if sine > 0.0 else 0.0
    angular = rotate(first.rotation, (x * rate, y * rate, z * rate))
    return _referred(
        tree, linear, angular, tracked, observer, reference, point, point_frame, middle
    )


def _referred(
    tree: FrameTree,
    linear: Vector,
    angular: Vector,
    tracked: str,
    observer: str,
    reference: str,
    point: Vector,
    point_frame: str,
    stamp: int,
) -> tuple[Vector, Vector]:
    """Return the velocity with the axes of another frame, and of another point."""
    there = tree.lookup(reference, observer, stamp)
    spin = rotate(there.rotation, angular)
    speed = rotate(there.rotation, linear)
    origin = tree.lookup(reference, tracked, stamp).translation
    frame = tree.lookup(reference, point_frame, stamp)
    place = add(rotate(frame.rotation, point), frame.translation)
    arm = add(place, minus(origin))
    return add(add(speed, _cross(there.translation, spin)), _cross(spin, arm)), spin


def _cross(a: Vector, b: Vector) -> Vector:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )
