"""Table of the systems that MuJoCo's steps update, and of the state that those use."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats
from gazelle.engines.mujoco.effort_limits import EffortLimits
from gazelle.engines.mujoco.state import StateViews
from gazelle.native.loop import SystemLoop
from gazelle.native.rows import first_of_run


class Hooks:
    """Numbers at one address, which a compiled model has (``contact_laws.joint_commands``).

    They are: how many systems there are, where their table is, a step [ns], where the times of
    worlds are; how many velocities of joints are limited, which ones, how, and where efforts are kept
    that do not act now, a row a world; the first of those velocities, if they are side by side; where
    rates of systems are, when they are due, and when the steps end that are made at once; bytes
    between the states of two worlds; where motors' velocities are in the first, and how many; where
    positions and quaternions of mocap bodies are, and how many.

    Args:
        nworld: Number of worlds.

    Attributes:
        address: Of the numbers.
        kept: Efforts that do not act now [N or N m], shape (nworld, limited velocities).
    """

    def __init__(self, nworld: int) -> None:
        self._numbers = np.zeros(18, np.int64)
        self._times = np.zeros(nworld, np.int64)
        self._numbers[3] = self._times.ctypes.data
        self.address = int(self._numbers.ctypes.data)
        self._loop: SystemLoop | None = None
        self._count = 0
        self._dofs = np.zeros(0, np.int64)
        self._speeds: Floats = np.zeros(0)
        self.kept: Floats = np.zeros((nworld, 0))

    def limit(self, limits: EffortLimits) -> None:
        """Set the velocity limits of joints."""
        self._dofs = np.ascontiguousarray(limits.dofs, np.int64)
        self._speeds = np.ascontiguousarray(limits.speed, np.float64)
        self.kept = np.zeros((len(self._times), len(self._dofs)))
        self._numbers[4] = len(self._dofs)
        self._numbers[5:8] = [each.ctypes.data for each in (self._dofs, self._speeds, self.kept)]
        self._numbers[8] = first_of_run(self._dofs)

    def show(self, state: StateViews, targets: Floats) -> None:
        """Share the velocities of motors and the mocap bodies of a state with systems."""
        position, quaternion = state.mocap_pos, state.mocap_quat
        self._numbers[12:] = (
            state.qpos.strides[0],
            targets.ctypes.data,
            targets.shape[1],
            position.ctypes.data,
            quaternion.ctypes.data,
            position.shape[1],
        )

    def begin(self, loop: SystemLoop, now_ns: int) -> None:
        """Start running systems in steps."""
        numbers = self._numbers
        if self._loop is not loop:
            self._loop = loop
            self._count, numbers[1], *others = loop.shared()
            numbers[9:12] = others
        self._times.fill(now_ns)
        numbers[0], numbers[2] = self._count, loop.step

    def end(self, applied: Floats) -> None:
        """Stop running systems in steps, and restore what was kept, shape (nworld, velocities)."""
        self._numbers[0] = 0
        if self._numbers[4] and np.count_nonzero(self.kept):
            rows = np.nonzero(self.kept)
            applied[rows[0], self._dofs[rows[1]]] = self.kept[rows]
            self.kept[:] = 0.0
