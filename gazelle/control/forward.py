"""Controllers that hand a command on to joints as it is."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.control.commands import rows_of
from gazelle.control.control_law import ControlLaw
from gazelle.control.controller import Controller
from gazelle.control.forward_law import ForwardLaw
from gazelle.control.interfaces import POSITION, JointHandles
from gazelle.control.parameters import ControllerParameters
from gazelle.control.values import JointTarget, JointTargets


class Forwarding(Controller):
    """Common base of single and group forwarding controllers.

    It starts with zero, or with the positions that joints have. No command is ever too old, and the
    last one stays in the joints after ``stopping``.
    """

    def open(self, joints: JointHandles) -> None:
        """Command these joints."""
        self._joints = joints
        self._commands: Floats = np.zeros((self.nworld, len(joints)))
        self._law = ForwardLaw(joints, self._commands)

    def take(self, values: object, worlds: Worlds | None) -> None:
        """Command from the next update on, in some worlds."""
        rows = self.rows(worlds)
        what = f"command of '{self.name}'"
        self._commands[rows] = rows_of(what, values, self._commands.shape[1], len(rows))  # type: ignore[arg-type]

    def starting(self, time: float) -> None:  # noqa: ARG002  it begins anyway
        """Set commands to the present positions; efforts and velocities to zero."""
        self._begin(None)

    def _begin(self, worlds: Worlds | None) -> None:
        rows = slice(None) if worlds is None else worlds
        held = self.interfaces == (POSITION,)
        self._commands[rows] = self._joints.position[rows] if held else 0.0

    def update(self, time: float, period: float) -> None:  # noqa: ARG002  the clock is exact
        """Forward the commands."""
        self._law.act(self.now_ns, period)

    def law(self) -> ControlLaw:
        """Return the native law, which does everything."""
        return self._law

    def reset(self, worlds: Worlds | None) -> None:
        """Hold the present positions."""
        self._begin(worlds)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the commands."""
        return {"commands": self._commands.copy()}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._commands[:] = state["commands"]


class ForwardCommandController(Forwarding):
    """Hands commands to one joint, as they are."""

    def init(self, parameters: ControllerParameters) -> None:
        """Read ``joint``."""
        self.open(self.claim(self.interfaces[0], [parameters.text("joint")]))
        self.add_input("command", JointTarget, self._receive)

    def _receive(self, target: JointTarget, worlds: Worlds | None) -> None:
        self.take(target.value, worlds)


class ForwardGroupController(Forwarding):
    """Hands commands to several joints, as they are."""

    def init(self, parameters: ControllerParameters) -> None:
        """Read ``joints``."""
        self.open(self.claim(self.interfaces[0], parameters.names("joints")))
        self.add_input("command", JointTargets, self._receive)

    def _receive(self, targets: JointTargets, worlds: Worlds | None) -> None:
        self.take(targets.values, worlds)
