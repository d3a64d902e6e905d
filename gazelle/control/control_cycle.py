# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""Joints read, controllers updated and commands written, step after step without Python."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import cython
import numpy as np
from cython.cimports.gazelle.control.control_law import ControlLaw
from cython.cimports.gazelle.control.joint_law import JointLaw
from cython.cimports.gazelle.native.joint_system import JointSystem


@cython.cclass
class ControlCycle(JointSystem):
    """The controllers of a robot that run, in all worlds.

    Args:
        nworld: Number of worlds.
        joints: Number of joints.

    Attributes:
        updated_ns: Time of the last update of controllers; -1 for never, shape (nworld,).
        written_ns: Time of the last write of commands, likewise.
    """

    def __init__(self, nworld: int, joints: int) -> None:
        JointSystem.__init__(self, nworld, joints)
        self.nworld = nworld
        self.updated_ns, self.written_ns = np.full((2, nworld), -1, np.int64)
        self.updated, self.written = self.updated_ns, self.written_ns
        self.table = np.zeros(0, np.int64)
        self.laws: list[ControlLaw] = []

    def run(self, hardware: JointLaw, laws: Sequence[ControlLaw], period: int, step: int) -> None:
        """Set the tasks of an update.

        Args:
            hardware: Reads joints and writes commands.
            laws: Of controllers that run, in this order.
            period: Of control [ns].
            step: Of the physics [ns].
        """
        self.hardware, self.laws = hardware, list(laws)
        self.table = np.array([id(each) for each in laws], np.int64)
        self.period, self.step = period, step

    def begin(self, updated: int, written: int) -> None:
        """Set the times of the last controller update and last write, in all worlds [ns].

        -1 for never.
        """
        last_update, last_write = updated, written
        for w in range(self.nworld):
            self.updated[w], self.written[w] = last_update, last_write

    def times(self) -> tuple[int, int]:
        """Return the times of the last update and write, in any world [ns]; -1 for never."""
        updated, written = self.updated[0], self.written[0]
        for w in range(1, self.nworld):
            updated, written = max(updated, self.updated[w]), max(written, self.written[w])
        return updated, written

    def advance(self, world: int, measured: Any, rates: Any, time: int) -> None:
        """Advance a world to a time: controllers once a period, limits always."""
        before, written = self.updated[world], self.written[world]
        passed = self.period if before < 0 else time - before
        if before < 0 or passed >= self.period:
            self.updated[world] = time
            self.hardware.read(world, measured, rates)
            self.control(world, time, passed / 1e9)
        since = self.step if written < 0 else time - written
        self.written[world] = time
        self.hardware.write(world, since / 1e9)

    def control(self, world: int, time: int, period: float) -> None:
        """Update controllers."""
        for index in range(self.table.shape[0]):
            if cython.compiled:
                place = cython.cast(cython.p_void, self.table[index])
                cython.cast(ControlLaw, place).control(world, time, period)
            else:
                self.laws[index].control(world, time, period)
