"""Many joints at once: where they are, and what their motors hold."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Bools, Floats, Indices
from gazelle.engines.mujoco.layout import MujocoLayout
from gazelle.engines.mujoco.many_links import ManyLinks
from gazelle.errors import EngineError

T = TypeVar("T")

_MOST = 64  # tables of a kind that are kept


@dataclass(frozen=True, slots=True)
class JointColumns:
    """First axes of some joints, looked up once.

    Attributes:
        places: Among positions, shape (joints,).
        dofs: Among velocities, likewise.
    """

    places: Indices
    dofs: Indices

    @classmethod
    def find(cls, layout: MujocoLayout, joints: Sequence[str]) -> JointColumns:
        """Look joints up.

        Raises:
            EngineError: There is no such joint, or it has no axis.
        """
        slots = [layout.joint(name)[0] for name in joints]
        for name, slot in zip(joints, slots, strict=True):
            if slot.position.stop - slot.position.start != 1:
                raise EngineError(f"joint '{name}' has no axis, and is read alone")
        places = np.array([slot.position.start for slot in slots], np.intp)
        return cls(places, np.array([slot.velocity.start for slot in slots], np.intp))


def motor_columns(layout: MujocoLayout, joints: Sequence[str]) -> Indices:
    """Columns of the velocities that motors hold on the first axes of joints, shape (joints,).

    Raises:
        EngineError: There is no motor on one of them.
    """
    return np.array([layout.motor(name).targets.start for name in joints], np.intp)


class ManyJoints(ManyLinks):
    """The part of ``gazelle.engines.table_engine.TableEngine`` for joints.

    Attributes:
        own_changes: Methods that change it beside those of every engine.
    """

    own_changes: tuple[str, ...] = ("drive_joints",)

    _looked_up: tuple[MujocoLayout, dict[tuple[str, tuple[str, ...]], Any]] | None = None

    def joint_positions(self, joints: Sequence[str]) -> Floats:
        """Positions of many joints' first axes [m or rad], shape (nworld, joints)."""
        places = self._look_up(self._known(), joints, JointColumns.find).places
        return self._state.qpos.take(places, axis=1)

    def joint_velocities(self, joints: Sequence[str]) -> Floats:
        """Velocities of many joints' first axes [m/s or rad/s], shape (nworld, joints)."""
        dofs = self._look_up(self._known(), joints, JointColumns.find).dofs
        return self._state.qvel.take(dofs, axis=1)

    def drive_joints(
        self, joints: Sequence[str], velocity: ArrayLike, chosen: Bools | None = None
    ) -> None:
        """Set the velocities that the motors of many joints hold; see the protocol."""
        columns = self._look_up(self._now(), joints, motor_columns)
        given = np.asarray(velocity, np.float64)
        if chosen is None:
            self._state.userdata[:, columns] = given
        else:
            self._state.userdata[:, columns[chosen]] = given[..., chosen]

    def _look_up(self, layout: MujocoLayout, names: Sequence[str], find: Callable[..., T]) -> T:
        """What ``find`` makes of names, once for a layout."""
        if self._looked_up is None or self._looked_up[0] is not layout:
            self._looked_up = layout, {}
        tables = self._looked_up[1]
        key = find.__qualname__, tuple(names)
        known: T | None = tables.get(key)
        if known is None:
            if len(tables) >= _MOST:
                tables.clear()
            known = tables[key] = find(layout, key[1])
        return known
