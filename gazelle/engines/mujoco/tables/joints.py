"""Rows of joints in MuJoCo's arrays, with their motors."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Bools, Floats, Indices, Worlds
from gazelle.engines.mujoco.layout import MujocoLayout
from gazelle.engines.mujoco.quaternions import joint_from_mujoco, joint_to_mujoco
from gazelle.engines.mujoco.state import rows_of
from gazelle.engines.mujoco.worlds import RunningWorlds
from gazelle.engines.reactions import Wrench
from gazelle.engines.table import Lookup
from gazelle.errors import EngineError
from gazelle.native.joint_system import JointSystem

_SIDES = ("lower", "upper")


class MujocoJointRow:
    """One joint with all its axes; see ``gazelle.engines.state.JointRow``.

    Args:
        run: Worlds that run.
        name: Scoped name.
        wrench: Measures what a joint transmits.
    """

    def __init__(
        self,
        run: RunningWorlds,
        name: str,
        wrench: Callable[[str, Worlds | None], Wrench],
    ) -> None:
        self._run, self._name, self._wrench = run, name, wrench

    def position(self, worlds: Worlds | None = None) -> Floats:
        """Return the position [m or rad], shape (n, axes)."""
        if axes := self._run.axes_at_zero(self._name):
            return np.zeros((self._run.nworld if worlds is None else len(worlds), axes))
        slots = self._run.known().joint(self._name)
        return joint_from_mujoco(_read(self._run.state.qpos, [s.position for s in slots], worlds))

    def velocity(self, worlds: Worlds | None = None) -> Floats:
        """Return the velocity [m/s or rad/s], shape (n, axes)."""
        slots = self._run.known().joint(self._name)
        return _read(self._run.state.qvel, [s.velocity for s in slots], worlds)

    def effort(self, worlds: Worlds | None = None) -> Floats:
        """Return the effort that ``set_effort`` applies [N or N m], shape (n, axes)."""
        slots = self._run.up_to_date().joint(self._name)
        return _read(self._run.state.qfrc_applied, [s.velocity for s in slots], worlds)

    def wrench(self, worlds: Worlds | None = None) -> Wrench:
        """Return the wrench of the child on the parent through the joint, about its origin."""
        return self._wrench(self._name, worlds)

    def set_position(self, position: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set the position [m or rad], shape (axes,) or (n, axes), to its limits at most."""
        self._run.placed = True
        slots = self._run.up_to_date().joint(self._name)
        positions = joint_to_mujoco(np.atleast_1d(np.asarray(position, np.float64)))
        if len(slots) > 1 or slots[0].position.stop - slots[0].position.start == 1:
            lower, upper = (
                self._run.parameter(f"joint_{side}", self._name, worlds) for side in _SIDES
            )
            positions = np.clip(positions, lower, np.maximum(lower, upper))
        self._write(self._run.state.qpos, [s.position for s in slots], positions, worlds)

    def set_velocity(self, velocity: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set the velocity [m/s or rad/s], shape (axes,) or (n, axes)."""
        slots = self._run.up_to_date().joint(self._name)
        self._write(self._run.state.qvel, [s.velocity for s in slots], velocity, worlds)

    def set_effort(self, effort: ArrayLike, worlds: Worlds | None = None) -> None:
        """Apply an effort until another is set [N or N m], shape (axes,) or (n, axes)."""
        slots = self._run.up_to_date().joint(self._name)
        efforts = np.atleast_1d(np.asarray(effort, np.float64))
        within = self._run.layout.limits.clamp(self._name, efforts)
        self._write(self._run.state.qfrc_applied, [s.velocity for s in slots], within, worlds)

    def set_motor_velocity(self, velocity: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set the velocity that the joint's motor holds [m/s or rad/s]."""
        columns = self._run.up_to_date().motor(self._name).targets
        velocities = np.asarray(velocity, np.float64)
        if columns.stop - columns.start == 1 and velocities.ndim == 1:
            velocities = velocities[:, None]
        self._run.state.userdata[rows_of(worlds), columns] = velocities

    def _write(
        self, array: Floats, columns: list[slice], values: ArrayLike, worlds: Worlds | None
    ) -> None:
        rows = np.atleast_1d(np.asarray(values, np.float64))
        start = 0
        for column in columns:
            width = column.stop - column.start
            array[rows_of(worlds), column] = rows[..., start : start + width]
            start += width
        self._run.stale = True


@dataclass(frozen=True, slots=True)
class JointColumns:
    """First axes of some joints in MuJoCo's arrays.

    Attributes:
        places: Columns of positions, shape (joints,).
        dofs: Columns of velocities and efforts, shape (joints,).
    """

    places: Indices
    dofs: Indices

    @classmethod
    def find(cls, layout: MujocoLayout, names: tuple[str, ...]) -> JointColumns:
        """Return look joints up.

        Raises:
            EngineError: There is no such joint, or it has no axis.
        """
        slots = [layout.joint(name)[0] for name in names]
        for name, slot in zip(names, slots, strict=True):
            if slot.position.stop - slot.position.start != 1:
                raise EngineError(f"joint '{name}' has no axis, and is read alone")
        places = np.array([slot.position.start for slot in slots], np.intp)
        return cls(places, np.array([slot.velocity.start for slot in slots], np.intp))


class MujocoJointRows:
    """First axes of several joints; see ``gazelle.engines.state.JointRows``.

    Args:
        run: Worlds that run.
        names: Scoped names.
        in_step: Returns whether the engine's steps can call systems.
    """

    def __init__(
        self, run: RunningWorlds, names: tuple[str, ...], in_step: Callable[[], bool]
    ) -> None:
        self._run, self._names, self._in_step = run, names, in_step
        self._columns = Lookup[MujocoLayout, JointColumns](lambda at: JointColumns.find(at, names))
        self._motors = Lookup[MujocoLayout, Indices](self._find_motors)
        self._known_limits: tuple[tuple[int, int], Floats, Floats] | None = None

    def position(self, worlds: Worlds | None = None) -> Floats:
        """Return positions [m or rad], shape (n, joints)."""
        qpos = self._run.state.qpos[rows_of(worlds)]
        return qpos.take(self._columns.within(self._run.known()).places, axis=1)

    def velocity(self, worlds: Worlds | None = None) -> Floats:
        """Return velocities [m/s or rad/s], shape (n, joints)."""
        qvel = self._run.state.qvel[rows_of(worlds)]
        return qvel.take(self._columns.within(self._run.known()).dofs, axis=1)

    def place(self, position: Floats, velocity: Floats, chosen: Bools) -> None:
        """Set positions and velocities of joints with one axis, to their limits at most."""
        columns = self._columns.within(self._run.up_to_date())
        within = np.clip(position, *self.limits())
        qpos, qvel = self._run.state.qpos, self._run.state.qvel
        if chosen.all():
            qpos[:, columns.places], qvel[:, columns.dofs] = within, velocity
        else:
            worlds, joints = np.nonzero(chosen)
            qpos[worlds, columns.places[joints]] = within[chosen]
            qvel[worlds, columns.dofs[joints]] = velocity[chosen]
        self._run.placed = self._run.stale = True

    def limits(self) -> tuple[Floats, Floats]:
        """Return least and greatest positions [m or rad], shape (nworld, joints) each."""
        writes = self._run.revision, self._run.parameters.writes
        known = self._known_limits
        if known is None or known[0] != writes:
            lower, upper = (
                np.concatenate([self._run.parameter(f"joint_{s}", n) for n in self._names], axis=1)
                for s in _SIDES
            )
            known = self._known_limits = writes, lower, np.maximum(lower, upper)
        return known[1:]

    @property
    def in_step(self) -> bool:
        """True where systems of the joints can act in steps: the integrator looks once at forces."""
        return self._in_step()

    def bind(self, system: JointSystem, *, in_step: bool = False) -> None:
        """Set a system's columns of the joints, valid for one revision."""
        recipe = self._run.latest
        if in_step and not recipe.hooks:
            self._run.change(replace(recipe, hooks=self._run.hooks.address))
        layout = self._run.up_to_date()
        columns = self._columns.within(layout)
        largest = [layout.limits.effort.get(name, (np.inf,))[0] for name in self._names]
        driven = self._run.recipe.motors
        motors = [layout.motor(n).targets.start if n in driven else -1 for n in self._names]
        system.bind(
            columns.places, columns.dofs, np.array(largest, np.float64), np.array(motors, np.intp)
        )

    def read(self, system: JointSystem) -> None:
        """Update positions and velocities of a bound system."""
        system.read(self._run.state.qpos, self._run.state.qvel)

    def act(self, system: JointSystem) -> None:
        """Apply the efforts and motors' velocities that a bound system has set."""
        system.act(self._run.state.qfrc_applied, self._run.state.userdata)
        self._run.stale = True

    def set_motor_velocity(self, velocity: ArrayLike, chosen: Bools | None = None) -> None:
        """Set the velocities that the motors hold [m/s or rad/s]."""
        targets, columns = self.motor_targets()
        velocities = np.asarray(velocity, np.float64)
        if chosen is None:
            targets[:, columns] = velocities
        else:
            targets[:, columns[chosen]] = velocities[..., chosen]

    def motor_targets(self) -> tuple[Floats, Indices]:
        """Return the velocities that motors hold, to be written, and the joints' columns."""
        columns = self._motors.within(self._run.up_to_date())
        return self._run.motor_targets, columns

    def _find_motors(self, layout: MujocoLayout) -> Indices:
        return np.array([layout.motor(name).targets.start for name in self._names], np.intp)


def _read(array: Floats, columns: list[slice], worlds: Worlds | None) -> Floats:
    """Return a copy of some columns, side by side."""
    rows = rows_of(worlds)
    if len(columns) == 1:
        return array[rows, columns[0]].copy()
    return np.concatenate([array[rows, each] for each in columns], axis=1)
