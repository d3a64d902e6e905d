"""Many joints at once: where they are, and what their motors hold."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Bools, Floats, Indices
from gazelle.engines.mujoco.layout import MujocoLayout
from gazelle.engines.mujoco.running import RunningWorlds
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


class Lookups:
    """What was found of names, once for a layout."""

    def __init__(self) -> None:
        self._known: tuple[MujocoLayout, dict[tuple[str, tuple[str, ...]], Any]] | None = None

    def find(self, layout: MujocoLayout, names: Sequence[str], make: Callable[..., T]) -> T:
        """What ``make`` makes of names, once for a layout."""
        if self._known is None or self._known[0] is not layout:
            self._known = layout, {}
        tables = self._known[1]
        key = make.__qualname__, tuple(names)
        known: T | None = tables.get(key)
        if known is None:
            if len(tables) >= _MOST:
                tables.clear()
            known = tables[key] = make(layout, key[1])
        return known


class ManyJoints:
    """The part of ``gazelle.engines.table_engine.TableEngine`` for joints.

    Args:
        run: What runs.
    """

    def __init__(self, run: RunningWorlds) -> None:
        self._run, self._found = run, Lookups()

    def joint_positions(self, joints: Sequence[str]) -> Floats:
        """Positions of many joints' first axes [m or rad], shape (nworld, joints)."""
        places = self._found.find(self._run.known(), joints, JointColumns.find).places
        return self._run.state.qpos.take(places, axis=1)

    def joint_velocities(self, joints: Sequence[str]) -> Floats:
        """Velocities of many joints' first axes [m/s or rad/s], shape (nworld, joints)."""
        dofs = self._found.find(self._run.known(), joints, JointColumns.find).dofs
        return self._run.state.qvel.take(dofs, axis=1)

    def drive_joints(
        self, joints: Sequence[str], velocity: ArrayLike, chosen: Bools | None = None
    ) -> None:
        """Set the velocities that the motors of many joints hold; see the protocol."""
        columns = self._found.find(self._run.now(), joints, motor_columns)
        given = np.asarray(velocity, np.float64)
        if chosen is None:
            self._run.state.userdata[:, columns] = given
        else:
            self._run.state.userdata[:, columns[chosen]] = given[..., chosen]
