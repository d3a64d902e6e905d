"""Difference of two values, and integration of a velocity by one step."""
# ruff: noqa: N802 - the names are KDL's

from __future__ import annotations

from typing import Any

from gazelle_ros.compat.PyKDL.frame import Frame
from gazelle_ros.compat.PyKDL.motion import Twist
from gazelle_ros.compat.PyKDL.rotation import Rotation


def diff(a: Any, b: Any, dt: float = 1.0) -> Any:
    """Return the velocity from a to b in `dt` seconds.

    It is a vector for rotations, a twist for frames.
    """
    if isinstance(a, Frame):
        return Twist(diff(a.p, b.p, dt), diff(a.M, b.M, dt))
    if isinstance(a, Rotation):
        return a * (a.Inverse(b).GetRot() / dt)
    return (b - a) / dt


def addDelta(a: Any, da: Any, dt: float = 1.0) -> Any:
    """Return a moved by a velocity for `dt` seconds; the inverse of `diff`."""
    if isinstance(a, Frame):
        return Frame(addDelta(a.M, da.rot, dt), addDelta(a.p, da.vel, dt))
    if isinstance(a, Rotation):
        step = a.Inverse(da) * dt
        return a * Rotation.Rot(step, step.Norm())
    return a + da * dt
