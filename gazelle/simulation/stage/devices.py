"""The grippers and actuators of a simulation."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from gazelle.array_types import Worlds
from gazelle.errors import SimulationError
from gazelle.simulation.stage.actuators import Actuator, actuators_of
from gazelle.simulation.stage.grippers import Gripper, grippers_of
from gazelle.simulation.stage.layout import StageRobot

if TYPE_CHECKING:
    from gazelle.simulation.stage.simulation import StageSimulation

Device = TypeVar("Device", Actuator, Gripper)


class Devices:
    """All that moves on robots.

    Args:
        simulation: Runs.

    Attributes:
        grippers: Of each robot that has some, by its index.
        actuators: Likewise.
    """

    def __init__(self, simulation: StageSimulation) -> None:
        self.grippers = grippers_of(simulation)
        self.actuators = actuators_of(simulation)

    def __bool__(self) -> bool:
        """Whether there are any."""
        return bool(self.grippers or self.actuators)

    def update(self, dt: float) -> None:
        """Move by a step of ``dt`` [s]."""
        for actuators in self.actuators.values():
            for actuator in actuators:
                actuator.update(dt)
        for grippers in self.grippers.values():
            for gripper in grippers:
                gripper.update()

    def follow(self, robot: int) -> None:
        """Take what is on a robot to where that was put."""
        for actuator in self.actuators.get(robot, ()):
            actuator.follow()

    def reset(self, worlds: Worlds | None) -> None:
        """As at the start."""
        for actuators in self.actuators.values():
            for actuator in actuators:
                actuator.reset(worlds)
        for grippers in self.grippers.values():
            for gripper in grippers:
                gripper.reset(worlds)


def pick(known: dict[int, list[Device]], robot: StageRobot, which: int, kind: str) -> Device:
    """One of the devices of a robot.

    Raises:
        SimulationError: It has none of this number.
    """
    found = known.get(robot.index, [])
    if not 0 <= which < len(found):
        raise SimulationError(f"'{robot.name}' has {len(found)} {kind}, no number {which}")
    return found[which]
