"""Binding of controllers in native code to MuJoCo's steps."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats
from gazelle.engines.mujoco.effort_limits import EffortLimits
from gazelle.native.joint_system import JointSystem, addresses
from gazelle.native.rows import first_of_run


class Hooks:
    """Numbers at one address, which a compiled model has (``contact_laws.joint_commands``).

    They are: how many systems act, where their addresses are, a step [ns], where the times of
    worlds are; how many velocities of joints are limited, which ones, how, and where efforts are kept
    that do not act now, a row a world; and the first of those velocities, if they are side by side.

    Args:
        nworld: Number of worlds.

    Attributes:
        address: Of the numbers.
        kept: Efforts that do not act now [N or N m], shape (nworld, limited velocities).
    """

    def __init__(self, nworld: int) -> None:
        self._numbers = np.zeros(9, np.int64)
        self._times = np.zeros(nworld, np.int64)
        self._numbers[3] = self._times.ctypes.data
        self.address = int(self._numbers.ctypes.data)
        self._systems: list[JointSystem] = []
        self._table = np.zeros(0, np.int64)
        self._dofs: np.ndarray[tuple[int], np.dtype[np.int64]] = self._table
        self._speeds: Floats = np.zeros(0)
        self.kept: Floats = np.zeros((nworld, 0))

    def limit(self, limits: EffortLimits) -> None:
        """Let joints have velocity limits."""
        self._dofs = np.ascontiguousarray(limits.dofs, np.int64)
        self._speeds = np.ascontiguousarray(limits.speed, np.float64)
        self.kept = np.zeros((len(self._times), len(self._dofs)))
        self._numbers[4] = len(self._dofs)
        self._numbers[5:8] = [each.ctypes.data for each in (self._dofs, self._speeds, self.kept)]
        self._numbers[8] = first_of_run(self._dofs)

    def begin(self, systems: Sequence[JointSystem], now_ns: int, step_ns: int) -> None:
        """Let systems act in the steps that follow."""
        numbers = self._numbers
        if self._systems != systems:
            self._systems, self._table = list(systems), addresses(systems)
            numbers[1] = self._table.ctypes.data
        self._times.fill(now_ns)
        numbers[0] = len(systems)
        numbers[2] = step_ns

    def end(self, applied: Floats) -> None:
        """Let none act any more, and put back what was kept, shape (nworld, velocities)."""
        self._numbers[0] = 0
        if np.count_nonzero(self.kept):
            rows = np.nonzero(self.kept)
            applied[rows[0], self._dofs[rows[1]]] = self.kept[rows]
            self.kept[:] = 0.0
