# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="misc"
"""What acts on the joints of a robot between the physics' own steps, in all worlds."""

from __future__ import annotations

from collections.abc import Sequence
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

# Systems by their addresses, for Python that runs the sources of compiled modules.
_KNOWN: dict[int, Any] = {}


@cython.cclass
class JointSystem(System):
    """Is told where joints are at the beginning of a step, and says what acts on them in it.

    An engine that takes it into its steps (``bind``) calls ``exchange``; else somebody fills
    ``position_in`` and ``velocity_in``, calls ``bring``, and acts on what came out. A row is a world.

    Args:
        nworld: Number of worlds.
        joints: Number of joints, each with one axis.

    Attributes:
        position_in: Of joints [m or rad], shape (nworld, joints).
        velocity_in: [m/s or rad/s], likewise.
        effort_out: What acts on joints [N or N m], likewise.
        pushed_out: Where that changed, likewise.
        speed_out: What motors hold [m/s or rad/s], likewise.
        driven_out: Where that changed, likewise.
    """

    def __init__(self, nworld: int, joints: int) -> None:
        System.__init__(self, 1)
        shape = (nworld, joints)
        self.position_in, self.velocity_in = np.zeros((2, *shape))
        self.effort_out, self.speed_out = np.zeros((2, *shape))
        self.pushed_out, self.driven_out = np.zeros((2, *shape), np.uint8)
        self.position, self.velocity = self.position_in, self.velocity_in
        self.effort, self.speed = self.effort_out, self.speed_out
        self.pushed, self.driven = self.pushed_out, self.driven_out
        self.count = joints
        self.position_at, self.velocity_at = start(self.position), start(self.velocity)
        self.effort_at = start(self.effort)
        self.pushed_at, self.driven_at = bytes_start(self.pushed), bytes_start(self.driven)
        nowhere = np.zeros(joints, np.intp)
        self.bind(nowhere, nowhere, np.zeros(joints), nowhere - 1)

    def bind(
        self,
        places: NDArray[np.intp],
        dofs: NDArray[np.intp],
        most: NDArray[np.float64],
        motors: NDArray[np.intp],
    ) -> None:
        """Say where an engine has the joints, shape (joints,) each.

        Args:
            places: Among its positions.
            dofs: Among its velocities and efforts.
            most: Largest efforts that it lets act [N or N m].
            motors: Among its motors; -1 for none.
        """
        self.places, self.dofs, self.most, self.motors = places, dofs, most, motors
        self.most_at, self.dofs_at = column(self.most), places_column(self.dofs)
        self.first_place, self.first_dof = first_of_run(places), first_of_run(dofs)

    def read(self, qpos: NDArray[np.float64], qvel: NDArray[np.float64]) -> None:
        """Read the joints of all worlds, from arrays as of ``exchange`` of each."""
        np.take(qpos, np.asarray(self.places), axis=1, out=self.position_in)
        np.take(qvel, np.asarray(self.dofs), axis=1, out=self.velocity_in)

    def act(self, applied: NDArray[np.float64], user: NDArray[np.float64]) -> None:
        """Let act what changed, in all worlds."""
        if self.pushed_out.any():
            most, rows = np.asarray(self.most), np.nonzero(self.pushed_out)
            held = np.clip(self.effort_out[rows], -most[rows[1]], most[rows[1]])
            applied[rows[0], np.asarray(self.dofs)[rows[1]]] = held
            self.pushed_out[:] = 0
        if self.driven_out.any():
            rows = np.nonzero(self.driven_out & (np.asarray(self.motors) >= 0))
            user[rows[0], np.asarray(self.motors)[rows[1]]] = self.speed_out[rows]
            self.driven_out[:] = 0

    def update(self, first: int, last: int, time: int) -> None:
        """Say what acts now; subclasses do."""

    def exchange(
        self, world: int, qpos: Any, qvel: Any, applied: Any, user: Any, time: int
    ) -> None:
        """Read the joints of a world, update, and let act what changed.

        Args:
            world: Which.
            qpos: All positions of the world.
            qvel: All velocities.
            applied: All efforts.
            user: Velocities that motors hold.
            time: Simulated time [ns].
        """
        count, first = self.count, world * self.count
        position, velocity = offset(self.position_at, first), offset(self.velocity_at, first)
        if self.first_place >= 0 and self.first_dof >= 0:
            copy(count, offset(qpos, self.first_place), position)
            copy(count, offset(qvel, self.first_dof), velocity)
        else:
            for i in range(count):
                position[i] = qpos[self.places[i]]
                velocity[i] = qvel[self.dofs[i]]
        self.update(world, world + 1, time)
        effort = offset(self.effort_at, first)
        pushed, driven = bytes_offset(self.pushed_at, first), bytes_offset(self.driven_at, first)
        for i in range(count):
            if pushed[i]:
                pushed[i] = 0
                most, value = self.most_at[i], effort[i]
                applied[self.dofs_at[i]] = min(max(value, -most), most)
            if driven[i]:
                driven[i] = 0
                if self.motors[i] >= 0:
                    user[self.motors[i]] = self.speed[world, i]


def copy(count: int, start: Any, end: Any) -> None:
    """Copy numbers, several at a time: what is read so again was not written one by one."""
    for i in range(count):
        end[i] = start[i]


def bring_systems(
    table: Any, count: int, world: int, qpos: Any, qvel: Any, applied: Any, user: Any, time: int
) -> None:
    """``exchange`` of systems whose addresses are in a table (``addresses``)."""
    for index in range(count):
        if cython.compiled:
            place = cython.cast(cython.p_void, table[index])
            cython.cast(JointSystem, place).exchange(world, qpos, qvel, applied, user, time)
        else:
            _KNOWN[int(table[index])].exchange(world, qpos, qvel, applied, user, time)


def addresses(systems: Sequence[JointSystem]) -> NDArray[np.int64]:
    """What ``bring_systems`` takes; good as long as the systems are kept."""
    if not cython.compiled:
        _KNOWN.clear()
        _KNOWN.update((id(each), each) for each in systems)
    return np.array([id(each) for each in systems], np.int64)
