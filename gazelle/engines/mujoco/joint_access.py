"""Where joints are, what pushes them, and what their motors hold."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.engines.mujoco.order import joint_from_mujoco, joint_to_mujoco
from gazelle.engines.mujoco.rows import rows_of
from gazelle.engines.mujoco.running import RunningWorlds

SIDES = ("lower", "upper")


class JointAccess:
    """The part of ``gazelle.engines.engine.Engine`` for joints.

    Args:
        run: What runs.
    """

    def __init__(self, run: RunningWorlds) -> None:
        self._run = run

    def joint_position(self, joint: str, worlds: Worlds | None = None) -> Floats:
        """Position [m or rad], shape (n, axes)."""
        if axes := self._run.axes_at_zero(joint):
            return np.zeros((self._run.nworld if worlds is None else len(worlds), axes))
        slots = self._run.known().joint(joint)
        return joint_from_mujoco(_read(self._run.state.qpos, [s.position for s in slots], worlds))

    def joint_velocity(self, joint: str, worlds: Worlds | None = None) -> Floats:
        """Velocity [m/s or rad/s], shape (n, axes)."""
        slots = self._run.known().joint(joint)
        return _read(self._run.state.qvel, [s.velocity for s in slots], worlds)

    def set_joint_position(
        self, joint: str, position: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Put a joint somewhere [m or rad], shape (axes,) or (n, axes), to its limits at most."""
        self._run.placed = True
        slots = self._run.now().joint(joint)
        given = joint_to_mujoco(np.atleast_1d(np.asarray(position, np.float64)))
        if len(slots) > 1 or slots[0].position.stop - slots[0].position.start == 1:
            lower, upper = (self._run.parameter(f"joint_{side}", joint, worlds) for side in SIDES)
            given = np.clip(given, lower, np.maximum(lower, upper))
        self._write(self._run.state.qpos, [s.position for s in slots], given, worlds)

    def set_joint_velocity(
        self, joint: str, velocity: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give a joint a velocity [m/s or rad/s], shape (axes,) or (n, axes)."""
        slots = self._run.now().joint(joint)
        self._write(self._run.state.qvel, [s.velocity for s in slots], velocity, worlds)

    def set_joint_effort(self, joint: str, effort: ArrayLike, worlds: Worlds | None = None) -> None:
        """Apply an effort [N or N m] until told otherwise, shape (axes,) or (n, axes)."""
        slots = self._run.now().joint(joint)
        given = np.atleast_1d(np.asarray(effort, np.float64))
        within = self._run.layout.limits.clamp(joint, given)
        self._write(self._run.state.qfrc_applied, [s.velocity for s in slots], within, worlds)

    def _write(
        self, array: Floats, columns: list[slice], values: ArrayLike, worlds: Worlds | None
    ) -> None:
        given = np.atleast_1d(np.asarray(values, np.float64))
        start = 0
        for column in columns:
            width = column.stop - column.start
            array[rows_of(worlds), column] = given[..., start : start + width]
            start += width
        self._run.stale = True

    def set_motor_velocity(
        self, joint: str, velocity: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set the velocity that a joint's motor holds; see the protocol."""
        columns = self._run.now().motor(joint).targets
        given = np.asarray(velocity, np.float64)
        if columns.stop - columns.start == 1 and given.ndim == 1:
            given = given[:, None]
        self._run.state.userdata[rows_of(worlds), columns] = given

    def joint_effort(self, joint: str, worlds: Worlds | None = None) -> Floats:
        """The effort that ``set_joint_effort`` applies now [N or N m], shape (n, axes)."""
        slots = self._run.now().joint(joint)
        rows = rows_of(worlds)
        return np.concatenate(
            [self._run.state.qfrc_applied[rows, s.velocity] for s in slots], axis=1
        )


def _read(array: Floats, columns: list[slice], worlds: Worlds | None) -> Floats:
    """A copy of some columns, side by side."""
    rows = rows_of(worlds)
    if len(columns) == 1:
        return array[rows, columns[0]].copy()
    return np.concatenate([array[rows, each] for each in columns], axis=1)
