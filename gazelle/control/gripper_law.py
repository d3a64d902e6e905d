# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""Law of a gripper's joint: hold a position, in native code."""

from __future__ import annotations

import cython
from cython.cimports.gazelle.control.control_law import ControlLaw
from cython.cimports.gazelle.control.pid_law import PidLaw
from cython.cimports.libc.math import fabs

from gazelle.array_types import Floats
from gazelle.control.interfaces import JointHandles


@cython.cclass
class GripperLaw(ControlLaw):
    """Hands positions on, or pushes towards them with a bounded effort.

    Args:
        joint: The one of the gripper.
        desired: Its positions [m or rad], shape (nworld,); used in place, as the others are.
        most: Largest efforts [N or N m], likewise.
        output: Acting effort, as far as it is known [N or N m], likewise.
    """

    def __init__(self, joint: JointHandles, desired: Floats, most: Floats, output: Floats) -> None:
        ControlLaw.__init__(self, len(desired))
        self.desired, self.most, self.output = desired, most, output
        self.position, self.velocity = joint.states.position, joint.states.velocity
        self.joint = joint.columns[0]
        command, columns = joint.commands[joint.fields[0]]
        self.command, self.column = command, columns[0]
        self.by_pid = False

    def push_by(self, pid: PidLaw) -> None:
        """Command the efforts that a PID with one loop makes of errors."""
        self.pid, self.by_pid = pid, True

    def control(self, world: int, now: int, period: float) -> None:  # noqa: ARG002  as of others
        """Control the gripper: apply an effort, or forward the command."""
        most = fabs(self.most[world])
        if not self.by_pid:
            self.command[world, self.column] = self.desired[world]
            self.output[world] = self.most[world]
            return
        error = self.desired[world] - self.position[world, self.joint]
        out = self.pid.push(world, 0, error, period, True, -self.velocity[world, self.joint])
        out = min(max(out, -most), most)
        self.output[world] = self.command[world, self.column] = out
