# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""Commands handed on, in native code."""

from __future__ import annotations

import cython
from cython.cimports.gazelle.control.control_law import ControlLaw

from gazelle.array_types import Floats
from gazelle.control.interfaces import JointHandles


@cython.cclass
class ForwardLaw(ControlLaw):
    """Hands commands to joints as they are.

    Args:
        joints: To be commanded.
        desired: The commands, shape (nworld, joints); used in place.
    """

    def __init__(self, joints: JointHandles, desired: Floats) -> None:
        ControlLaw.__init__(self, len(desired))
        self.desired = desired
        self.command, self.columns = joints.commands[joints.fields[0]]

    def control(self, world: int, now: int, period: float) -> None:  # noqa: ARG002  as of others
        """Copy them."""
        for i in range(self.columns.shape[0]):
            self.command[world, self.columns[i]] = self.desired[world, i]
