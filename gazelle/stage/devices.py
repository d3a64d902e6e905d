"""The grippers and actuators of a simulation."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.errors import SimulationError
from gazelle.stage.actuators import Actuator, actuators_of
from gazelle.stage.grippers import Gripper, grippers_of
from gazelle.stage.robots import StageRobot
from gazelle.stage.stage_bodies import StageBodies

Device = TypeVar("Device", Actuator, Gripper)


class Devices:
    """All that moves on robots.

    Args:
        simulation: Runs.

    Attributes:
        grippers: Of each robot that has some, by its index.
        actuators: Likewise.
    """

    def __init__(self, simulation: StageBodies) -> None:
        self.grippers = grippers_of(simulation)
        self.actuators = actuators_of(simulation)

    def __bool__(self) -> bool:
        """Return whether there are any."""
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
        """Move the devices on a robot after it was placed."""
        for actuator in self.actuators.get(robot, ()):
            actuator.follow()

    def reset(self, worlds: Worlds | None) -> None:
        """Reset the devices to their start."""
        for actuators in self.actuators.values():
            for actuator in actuators:
                actuator.reset(worlds)
        for grippers in self.grippers.values():
            for gripper in grippers:
                gripper.reset(worlds)

    def copy_from(
        self, other: Devices, pairs: Iterable[tuple[int, int]], things: Mapping[int, int]
    ) -> None:
        """Copy the state of other robots' devices.

        Args:
            other: Devices before the change.
            pairs: Indices of the robots that both have, there and here.
            things: Index now of each object before.
        """
        for there, here in pairs:
            for old, new in zip(other._of(there), self._of(here), strict=False):
                for name, values in new.arrays().items():
                    values[:] = old.arrays()[name]
            for gripper in self.grippers.get(here, ()):
                gripper.find(things)

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state, for a snapshot."""
        return {name: values.copy() for name, values in self._arrays().items()}

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        for name, values in self._arrays().items():
            values[:] = state[name]

    def _arrays(self) -> dict[str, NDArray[Any]]:
        return {
            f"{robot}.{which}.{name}": values
            for robot in sorted({*self.grippers, *self.actuators})
            for which, each in enumerate(self._of(robot))
            for name, values in each.arrays().items()
        }

    def _of(self, robot: int) -> list[Gripper | Actuator]:
        return [*self.grippers.get(robot, ()), *self.actuators.get(robot, ())]


def pick(known: dict[int, list[Device]], robot: StageRobot, which: int, kind: str) -> Device:
    """Return one of the devices of a robot.

    Raises:
        SimulationError: It has none of this number.
    """
    found = known.get(robot.index, [])
    if not 0 <= which < len(found):
        raise SimulationError(f"'{robot.name}' has {len(found)} {kind}, no number {which}")
    return found[which]
