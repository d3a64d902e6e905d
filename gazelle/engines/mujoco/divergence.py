"""Divergence report: the likely cause, from a world's last good state."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gazelle.array_types import Floats
from gazelle.engines.mujoco.layout import MujocoLayout
from gazelle.engines.mujoco.state import StateViews


def divergence_report(
    layout: MujocoLayout, views: StateViews, states: Floats, before: Floats
) -> str:
    """Describe what of a world was not finite, or else moved fastest, before it diverged.

    Args:
        layout: Names of what runs.
        views: Views of ``states``.
        states: Of all worlds, shape (nworld, size).
        before: The world's last good state, shape (size,).

    Returns:
        A few words, such as ``joint 'arm::elbow' moved at 3e+05``; empty when nothing moves.
    """
    for what, view, columns in _places(layout, views):
        values = before[_within(states, view)].reshape(view.shape[1:])[columns]
        if not np.isfinite(values).all():
            return f"{what} was not finite"
    speeds = before[_within(states, views.qvel)]
    fastest, name = 0.0, ""
    for what, columns in _moving(layout):
        speed = float(np.abs(speeds[columns]).max())
        if speed > fastest:
            fastest, name = speed, what
    return f"{name} moved at {fastest:.3g}" if name else ""


def _within(states: Floats, view: Floats) -> slice:
    """Return the columns of the states that a view shows."""
    start = (view.ctypes.data - states.ctypes.data) // states.itemsize
    return slice(start, start + int(np.prod(view.shape[1:])))


def _places(layout: MujocoLayout, views: StateViews) -> Iterator[tuple[str, Floats, slice | int]]:
    for name, slots in layout.joints.items():
        for slot in slots:
            yield f"the position of joint '{name}'", views.qpos, slot.position
            yield f"the velocity of joint '{name}'", views.qvel, slot.velocity
            yield f"the effort on joint '{name}'", views.qfrc_applied, slot.velocity
    for name, link in layout.links.items():
        if link.free is not None:
            yield f"the pose of link '{name}'", views.qpos, link.free.position
            yield f"the velocity of link '{name}'", views.qvel, link.free.velocity
        if link.mocap is not None:
            yield f"the position of link '{name}'", views.mocap_pos, link.mocap
            yield f"the orientation of link '{name}'", views.mocap_quat, link.mocap
        elif link.body:
            yield f"the force on link '{name}'", views.xfrc_applied, link.body
    for name, motor in layout.motors.items():
        yield f"the command of the motor on '{name}'", views.userdata, motor.targets


def _moving(layout: MujocoLayout) -> Iterator[tuple[str, slice]]:
    for name, slots in layout.joints.items():
        for slot in slots:
            yield f"joint '{name}'", slot.velocity
    for name, link in layout.links.items():
        if link.free is not None:
            yield f"link '{name}'", link.free.velocity
