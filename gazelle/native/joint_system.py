# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="misc"
"""Systems that act on the joints of a robot between the physics' own steps, in all worlds."""

from __future__ import annotations

from typing import Any

import cython
import numpy as np
from cython.cimports.gazelle.native.rows import (
    bytes_offset,
    bytes_start,
    column,
    offset,
    places_column,
    start,
)
from cython.cimports.gazelle.native.system import System
from numpy.typing import NDArray

from gazelle.native.rows import first_of_run


@cython.cclass
class JointSystem(System):
    """Reads joints at the start of a step, and sets what acts on them in it.

    An engine that takes it into its steps (``bind``) calls ``exchange``, which lets it see joints where
    the engine has them; else a caller fills ``position_in`` and ``velocity_in``, calls ``update_from_python``, and
    acts on what came out. A row is a world. Subclasses override ``advance``.

    Args:
        nworld: Number of worlds.
        joints: Number of joints, each with one axis.

    Attributes:
        position_in: Of joints [m or rad], shape (nworld, joints); not filled by ``exchange``.
        velocity_in: [m/s or rad/s], likewise.
        effort_out: Efforts on joints [N or N m], likewise.
        pushed_out: 1 where that changed, else 0, likewise.
        speed_out: Speeds that motors hold [m/s or rad/s], likewise.
        driven_out: Mask of changes of that, likewise.
    """

    def __init__(self, nworld: int, joints: int) -> None:
        System.__init__(self, 1)
        shape = (nworld, joints)
        self.position_in, self.velocity_in = np.zeros((2, *shape))
        self.effort_out, self.pushed_out, self.speed_out = np.zeros((3, *shape))
        self.driven_out = np.zeros(shape, np.uint8)
        self.position, self.velocity = self.position_in, self.velocity_in
        self.effort, self.speed = self.effort_out, self.speed_out
        self.pushed, self.driven = self.pushed_out, self.driven_out
        self.count = joints
        self.position_at, self.velocity_at = start(self.position), start(self.velocity)
        self.effort_at, self.pushed_at = start(self.effort), start(self.pushed)
        self.driven_at = bytes_start(self.driven)
        nowhere = np.zeros(joints, np.intp)
        self.bind(nowhere, nowhere, np.zeros(joints), nowhere - 1)

    def bind(
        self,
        places: NDArray[np.intp],
        dofs: NDArray[np.intp],
        most: NDArray[np.float64],
        motors: NDArray[np.intp],
    ) -> None:
        """Set the indices of the joints in an engine, shape (joints,) each.

        Args:
            places: Among its positions.
            dofs: Among its velocities and efforts.
            most: Largest efforts that it applies [N or N m].
            motors: Among its motors; -1 for none.
        """
        self.places, self.dofs, self.most, self.motors = places, dofs, most, motors
        self.most_at, self.dofs_at = column(self.most), places_column(self.dofs)
        self.first_place, self.first_dof = first_of_run(places), first_of_run(dofs)
        self.moves = bool((motors >= 0).any())

    def read(self, qpos: NDArray[np.float64], qvel: NDArray[np.float64]) -> None:
        """Read the joints of all worlds, from arrays as of ``exchange`` of each."""
        np.take(qpos, np.asarray(self.places), axis=1, out=self.position_in)
        np.take(qvel, np.asarray(self.dofs), axis=1, out=self.velocity_in)

    def act(self, applied: NDArray[np.float64], user: NDArray[np.float64]) -> None:
        """Apply the changed commands in all worlds."""
        if self.pushed_out.any():
            most, rows = np.asarray(self.most), np.nonzero(self.pushed_out)
            held = np.clip(self.effort_out[rows], -most[rows[1]], most[rows[1]])
            applied[rows[0], np.asarray(self.dofs)[rows[1]]] = held
            self.pushed_out[:] = 0.0
        if self.driven_out.any():
            rows = np.nonzero(self.driven_out & (np.asarray(self.motors) >= 0))
            user[rows[0], np.asarray(self.motors)[rows[1]]] = self.speed_out[rows]
            self.driven_out[:] = 0

    def update(self, first: int, last: int, time: int) -> None:
        """Call ``advance`` for worlds, with joints from ``position_in`` and ``velocity_in``."""
        for w in range(first, last):
            measured = offset(self.position_at, w * self.count)
            rates = offset(self.velocity_at, w * self.count)
            self.advance(w, measured, rates, time)

    def advance(self, world: int, measured: Any, rates: Any, time: int) -> None:
        """Set the commands of a world; subclasses implement it.

        Args:
            world: Index of the world.
            measured: Positions of the joints, in order.
            rates: Their velocities.
            time: Simulated time [ns].
        """

    def exchange(
        self, world: int, qpos: Any, qvel: Any, applied: Any, user: Any, time: int
    ) -> None:
        """Read the joints of a world, advance, and apply the changed commands.

        Args:
            world: Index of the world.
            qpos: All positions of the world.
            qvel: All velocities.
            applied: All efforts.
            user: Velocities that motors hold.
            time: Simulated time [ns].
        """
        count, first = self.count, world * self.count
        if self.first_place >= 0:
            measured = offset(qpos, self.first_place)
        else:
            measured = offset(self.position_at, first)
            for i in range(count):
                measured[i] = qpos[self.places[i]]
        if self.first_dof >= 0:
            rates = offset(qvel, self.first_dof)
        else:
            rates = offset(self.velocity_at, first)
            for i in range(count):
                rates[i] = qvel[self.dofs[i]]
        self.advance(world, measured, rates, time)
        effort, pushed = offset(self.effort_at, first), offset(self.pushed_at, first)
        if self.first_dof >= 0:
            act_in_row(count, effort, pushed, self.most_at, offset(applied, self.first_dof))
        else:
            for i in range(count):
                if pushed[i] != 0.0:
                    pushed[i] = 0.0
                    most, value = self.most_at[i], effort[i]
                    applied[self.dofs_at[i]] = min(max(value, -most), most)
        if self.moves:
            self.drive(world, user)

    def drive(self, world: int, user: Any) -> None:
        """Set the changed velocities of motors."""
        count = self.count
        driven = bytes_offset(self.driven_at, world * count)
        for i in range(count):
            if driven[i]:
                driven[i] = 0
                if self.motors[i] >= 0:
                    user[self.motors[i]] = self.speed[world, i]


def copy(count: int, start: Any, end: Any) -> None:
    """Copy numbers, several at a time: what is read so again was not written one by one."""
    for i in range(count):
        end[i] = start[i]


def act_in_row(count: int, effort: Any, pushed: Any, most: Any, applied: Any) -> None:
    """Apply changed efforts of adjacent joints, several at a time."""
    for i in range(count):
        held = min(max(effort[i], -most[i]), most[i])
        applied[i] = held if pushed[i] != 0.0 else applied[i]
        pushed[i] = 0.0
