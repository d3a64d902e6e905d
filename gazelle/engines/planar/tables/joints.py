"""Rows of joints in the arrays of planar worlds, with their motors."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Bools, Floats, Indices, Worlds
from gazelle.engines.planar.layout import PlanarLayout
from gazelle.engines.planar.unsupported import refuse
from gazelle.engines.planar.worlds import PlanarState, rows_of
from gazelle.engines.reactions import Wrench
from gazelle.engines.table import Lookup
from gazelle.errors import EngineError
from gazelle.native.joint_system import JointSystem


class PlanarJointRow:
    """One joint with all its axes; see ``gazelle.engines.state.JointRow``.

    Args:
        run: Worlds that run.
        name: Scoped name.
    """

    def __init__(self, run: PlanarState, name: str) -> None:
        self._run, self._name = run, name

    def position(self, worlds: Worlds | None = None) -> Floats:
        """Return the position [m or rad], shape (n, axes)."""
        return self._run.angles[rows_of(worlds), self._run.axes(self._name)].copy()

    def velocity(self, worlds: Worlds | None = None) -> Floats:
        """Return the velocity [m/s or rad/s], shape (n, axes)."""
        return self._run.rates[rows_of(worlds), self._run.axes(self._name)].copy()

    def effort(self, worlds: Worlds | None = None) -> Floats:
        """Return zeros, shape (n, axes): efforts do not act here."""
        return np.zeros_like(self.position(worlds))

    def wrench(self, worlds: Worlds | None = None) -> Wrench:
        """Raise an error: the plane has no forces."""
        del worlds
        raise refuse(f"the wrench in '{self._name}'")

    def set_position(self, position: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set the position [m or rad], shape (axes,) or (n, axes)."""
        self._run.angles[rows_of(worlds), self._run.axes(self._name)] = position

    def set_velocity(self, velocity: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set the velocity, which the joint keeps [m/s or rad/s], shape (axes,) or (n, axes)."""
        self._run.rates[rows_of(worlds), self._run.axes(self._name)] = velocity

    def set_effort(self, effort: ArrayLike, worlds: Worlds | None = None) -> None:
        """Raise an error: the plane has no forces."""
        del effort, worlds
        raise refuse(f"an effort on '{self._name}'")

    def set_motor_velocity(self, velocity: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set the velocity that the joint's motor holds [m/s or rad/s], shape () or (n,)."""
        column = motor_column(self._run, self._name)
        self._run.targets[rows_of(worlds), column] = velocity


class PlanarJointRows:
    """First axes of several joints; see ``gazelle.engines.state.JointRows``.

    Args:
        run: Worlds that run.
        names: Scoped names.
    """

    def __init__(self, run: PlanarState, names: tuple[str, ...]) -> None:
        self._run, self._names = run, names
        self._columns = Lookup[PlanarLayout, Indices](
            lambda _: np.array([run.axes(name).start for name in names], np.intp)
        )

    def position(self, worlds: Worlds | None = None) -> Floats:
        """Return positions [m or rad], shape (n, joints)."""
        return self._run.angles[rows_of(worlds)].take(
            self._columns.within(self._run.layout), axis=1
        )

    def velocity(self, worlds: Worlds | None = None) -> Floats:
        """Return velocities [m/s or rad/s], shape (n, joints)."""
        return self._run.rates[rows_of(worlds)].take(self._columns.within(self._run.layout), axis=1)

    def limits(self) -> tuple[Floats, Floats]:
        """Raise an error: the plane has no limits of joints."""
        raise refuse("limits of joints")

    def place(self, position: Floats, velocity: Floats, chosen: Bools) -> None:
        """Set positions and velocities [m or rad, m/s or rad/s], shape (nworld, joints)."""
        worlds, joints = np.nonzero(chosen)
        columns = self._columns.within(self._run.layout)[joints]
        self._run.angles[worlds, columns] = position[chosen]
        self._run.rates[worlds, columns] = velocity[chosen]

    in_step = False

    def bind(self, system: JointSystem, *, in_step: bool = False) -> None:
        """Do nothing: the plane's steps call no systems of joints."""

    def read(self, system: JointSystem) -> None:
        """Update positions and velocities of a system."""
        system.position_in[:], system.velocity_in[:] = self.position(), self.velocity()

    def act(self, system: JointSystem) -> None:
        """Set the motors' velocities that a system has set.

        Raises:
            EngineError: It has set efforts.
        """
        if system.pushed_out.any():
            raise refuse(f"efforts on '{self._names[0]}' and others")
        worlds, joints = np.nonzero(system.driven_out)
        for name in {self._names[joint] for joint in joints.tolist()}:
            motor_column(self._run, name)
        self._run.targets[worlds, self._columns.within(self._run.layout)[joints]] = (
            system.speed_out[worlds, joints]
        )
        system.driven_out[:] = 0

    def set_motor_velocity(self, velocity: ArrayLike, chosen: Bools | None = None) -> None:
        """Set the velocities that the motors hold [m/s or rad/s]."""
        targets, columns = self.motor_targets()
        given, which = np.asarray(velocity, np.float64), slice(None) if chosen is None else chosen
        targets[:, columns[which]] = given[..., which]

    def motor_targets(self) -> tuple[Floats, Indices]:
        """Return the velocities that motors hold, to be written, and the joints' columns."""
        for name in self._names:
            motor_column(self._run, name)
        return self._run.targets, self._columns.within(self._run.layout)


def motor_column(run: PlanarState, joint: str) -> int:
    """Return the column of a joint's motor.

    Raises:
        EngineError: There is no motor on the joint.
    """
    column = int(run.axes(joint).start)
    if joint not in run.recipe.motors:
        raise EngineError(f"there is no motor on joint '{joint}'", hint="give it one first")
    return column
