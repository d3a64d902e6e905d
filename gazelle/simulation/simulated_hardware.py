"""Base class of simulated robot hardware for ros_control."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from gazelle.array_types import Bools
from gazelle.control import EFFORT, POSITION, VELOCITY, RobotHardware
from gazelle.control.limits import JointLimits
from gazelle.control.pid import PidGains
from gazelle.description import Model, Transmission
from gazelle.simulation.robot import Robot

INTERFACES = (EFFORT, POSITION, VELOCITY)
"""Those that a simulated joint can be commanded through."""


@dataclass(frozen=True, slots=True)
class CommandedJoint:
    """A joint that controllers command.

    Attributes:
        name: Within the robot.
        interfaces: Command interfaces, at least one; the first one is used at first.
        limits: Limits of the commands.
        gains: For positions and velocities; None to be put there.
    """

    name: str
    interfaces: tuple[str, ...]
    limits: JointLimits = field(default_factory=JointLimits)
    gains: PidGains | None = None


@dataclass(frozen=True, slots=True)
class HardwareSetup:
    """Setup of the robot's side of control.

    Attributes:
        namespace: Of the robot.
        joints: To be commanded.
        model: The robot as its URDF describes it.
        parameters: Of the plugin, as tags; None without one.
        transmissions: Between the joints and actuators that are known; none where they do not count.
    """

    namespace: str
    joints: Sequence[CommandedJoint]
    model: Model
    parameters: Any = None
    transmissions: Sequence[Transmission] = ()


class SimulatedHardware(RobotHardware):
    """Base class of the robot's side in a simulation; ``robotSimType`` may name a subclass of yours.

    Args:
        robot: In the simulation.
        setup: Setup of its files.
    """

    def __init__(self, robot: Robot, setup: HardwareSetup) -> None:
        super().__init__(robot.simulation.nworld)
        self.robot, self.setup = robot, setup

    @property
    def idle(self) -> bool:
        """True if there is nothing to do while no controller runs."""
        return False

    @property
    def motors(self) -> frozenset[str]:
        """The joints on which it has put motors; what takes its place switches those off."""
        return frozenset()

    def measure(self, time: float) -> None:
        """Read joints that may have been put elsewhere since the last ``read``, though no time passed.

        Args:
            time: Now [s].
        """
        self.read(time, 0.0)

    def stop_emergency(self, stopped: Bools) -> None:
        """Set whether the emergency stop is pressed, shape (nworld,); called before every step."""
