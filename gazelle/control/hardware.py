"""Hardware of a robot: the interfaces that controllers read and command."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.control.interfaces import (
    HardwareInterface,
    JointCommandInterface,
    JointStateInterface,
    cpp_name,
)
from gazelle.errors import ControlError, did_you_mean


@dataclass(frozen=True, slots=True)
class ControllerInfo:
    """A controller as the robot's side sees it.

    Attributes:
        name: Its name.
        type: Such as ``effort_controllers/JointTrajectoryController``.
        claimed: Resources by interface (``hardware_interface/EffortJointInterface``), sorted.
    """

    name: str
    type: str
    claimed: Mapping[str, tuple[str, ...]]


class SwitchResult(Enum):
    """Progress of a robot's switch of its joints' interfaces."""

    DONE = "done"
    ONGOING = "ongoing"
    ERROR = "error"


class RobotHardware:
    """A robot that controllers read and command, in every world at once.

    Subclass it for a robot of your own: register joints and interfaces, and fill ``read`` and
    ``write``. A robot that needs time to switch its joints from one interface to another says so in
    ``switch_result``.

    Args:
        nworld: Number of worlds; 1 for a single robot.
    """

    def __init__(self, nworld: int = 1) -> None:
        self.nworld = nworld
        self.interfaces: dict[str, HardwareInterface] = {}

    def register(self, interface: HardwareInterface) -> None:
        """Register an interface.

        Raises:
            ControlError: There is one of that name.
        """
        if interface.name in self.interfaces:
            raise ControlError(f"the interface '{interface.name}' is registered already")
        self.interfaces[interface.name] = interface

    def register_joints(
        self, names: Sequence[str], commands: Mapping[str, Sequence[str]] | None = None
    ) -> JointStateInterface:
        """Register joints with the common interfaces.

        Args:
            names: Of all joints.
            commands: Names of those that can be commanded, by interface.

        Returns:
            What ``read`` has to fill.
        """
        states = JointStateInterface(names, self.nworld)
        self.register(states)
        for interface, joints in (commands or {}).items():
            self.register(JointCommandInterface(interface, joints, states))
        return states

    def interface(self, name: str) -> HardwareInterface:
        """Return an interface by its name, with ``/`` or ``::``.

        Raises:
            ControlError: The robot has none of that name.
        """
        found = self.interfaces.get(name.replace("::", "/"))
        if found is None:
            raise ControlError(
                f"this controller requires a hardware interface of type '{cpp_name(name)}', which the "
                "robot does not have",
                hint=did_you_mean(name, self.interfaces),
            )
        return found

    def read(self, time: float, period: float) -> None:
        """Measure; called before controllers are updated.

        Args:
            time: Now [s].
            period: Since the last time [s].
        """

    def write(self, time: float, period: float) -> None:
        """Apply the commands; called after controllers are updated.

        Args:
            time: Now [s].
            period: Since the last time [s].
        """

    def prepare_switch(
        self, start: Sequence[ControllerInfo], stop: Sequence[ControllerInfo]
    ) -> bool:
        """Return whether a switch is possible; it is not made yet."""
        del start, stop
        return True

    def do_switch(self, start: Sequence[ControllerInfo], stop: Sequence[ControllerInfo]) -> None:
        """Start to switch joints over."""

    def switch_result(self, controller: ControllerInfo | None = None) -> SwitchResult:
        """Return the progress of a switch, of the joints of one controller, or of all."""
        del controller
        return SwitchResult.DONE

    def reset(self, worlds: Worlds | None) -> None:
        """Reset these worlds (all if None) to the state after loading."""

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return all mutable state, for a snapshot."""
        kept: dict[str, NDArray[np.generic]] = {}
        for name, interface in self.interfaces.items():
            if isinstance(interface, JointStateInterface):
                kept |= {
                    f: getattr(interface, f).copy() for f in ("position", "velocity", "effort")
                }
            if isinstance(interface, JointCommandInterface):
                kept |= {f"{name}.{f}": values.copy() for f, values in interface.commands.items()}
        return kept

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        for name, interface in self.interfaces.items():
            if isinstance(interface, JointStateInterface):
                for field in ("position", "velocity", "effort"):
                    getattr(interface, field)[:] = state[field]
            if isinstance(interface, JointCommandInterface):
                for field, values in interface.commands.items():
                    values[:] = state[f"{name}.{field}"]
