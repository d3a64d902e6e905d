# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""Joints brought to positions or velocities by PID, in native code."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import cython
import numpy as np
from cython.cimports.gazelle.control.angle_law import distance
from cython.cimports.gazelle.control.control_law import ControlLaw
from cython.cimports.gazelle.control.limit_law import clamp
from cython.cimports.gazelle.control.pid_law import PidLaw

from gazelle.array_types import Bools, Floats
from gazelle.control.interfaces import JointHandles


@cython.cclass
class JointPidLaw(ControlLaw):
    """A PID for each of some joints.

    Args:
        joints: To be read and commanded.
        pid: With as many loops.
        targets: Positions [m or rad] or velocities [m/s or rad/s], shape (nworld, joints); used in
            place, as ``error`` is.
        error: What they lack, likewise.
    """

    def __init__(self, joints: JointHandles, pid: PidLaw, targets: Floats, error: Floats) -> None:
        ControlLaw.__init__(self, len(targets))
        self.pid, self.targets, self.error = pid, targets, error
        self.position, self.velocity = joints.states.position, joints.states.velocity
        self.joints = joints.columns
        self.command, self.columns = joints.commands[joints.fields[0]]
        self.by_velocity = True

    def hold_positions(self, limits: Sequence[Floats], turning: Bools, endless: Bools) -> None:
        """Bring joints to positions instead, within limits.

        Args:
            limits: Lower and upper ones [m or rad], shape (joints,) each.
            turning: Which joints turn, shape (joints,).
            endless: Which of them do so without limits.
        """
        self.by_velocity = False
        self.lower, self.upper = (np.array(each, np.float64) for each in limits)
        self.turning, self.endless = (self._flags(each) for each in (turning, endless))

    @staticmethod
    def _flags(values: Bools) -> Any:
        return np.array(values, np.uint8)

    def control(self, world: int, now: int, period: float) -> None:  # noqa: ARG002  as of others
        """Push towards the targets; positions the way round that limits allow."""
        for i in range(self.joints.shape[0]):
            wanted = self.targets[world, i]
            if self.by_velocity:
                lack = wanted - self.velocity[world, self.joints[i]]
            else:
                wanted = clamp(wanted, self.lower[i], self.upper[i])
                self.targets[world, i] = wanted
                at = self.position[world, self.joints[i]]
                if self.turning[i]:
                    lack = distance(at, wanted, self.endless[i], self.lower[i], self.upper[i])
                else:
                    lack = wanted - at
            self.error[world, i] = lack
            self.command[world, self.columns[i]] = self.pid.push(world, i, lack, period, False, 0.0)
