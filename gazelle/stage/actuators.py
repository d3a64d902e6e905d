"""Actuators, which move mounted models along or about an axis."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Worlds
from gazelle.errors import SimulationError
from gazelle.simulation.inputs import chosen
from gazelle.stage.robots import MountedActuator, StageRobot
from gazelle.stage.stage_bodies import StageBodies


@checked(SimulationError)
class Actuator:
    """An actuator of a robot, in all worlds.

    Its laws are those of Stage: at a wanted speed it goes until the end of its range; towards a
    wanted position its speed is the way that is left, a second; never faster than it can.
    (Stage 4.3 has these laws, but its actuators do not move.)

    Args:
        simulation: Runs.
        robot: Its robot.
        actuator: Model that it moves.

    Attributes:
        position: [m or rad], shape (nworld,); to be read.
    """

    def __init__(
        self, simulation: StageBodies, robot: StageRobot, actuator: MountedActuator
    ) -> None:
        self._simulation, self._robot, self._actuator = simulation, robot, actuator
        self._device = actuator.device
        count = simulation.nworld
        self.position = np.full(count, actuator.device.start)
        self._goal, self._towards = np.zeros(count), np.zeros(count, np.bool_)

    def set_speed(self, speed: float, worlds: Worlds | None = None) -> None:
        """Set a speed [m/s or rad/s].

        Raises:
            SimulationError: It is not finite, or there is no such world.
        """
        self._want(speed, worlds, towards=False)

    def go_to(self, position: float, worlds: Worlds | None = None) -> None:
        """Set a target position [m or rad], clipped to its range.

        Raises:
            SimulationError: It is not finite, or there is no such world.
        """
        low, high = self._device.range
        self._want(min(max(position, low), high), worlds, towards=True)

    def _want(self, goal: float, worlds: Worlds | None, *, towards: bool) -> None:
        which = self._rows(worlds)
        self._goal[which], self._towards[which] = goal, towards

    def _rows(self, worlds: Worlds | None) -> slice | Worlds:
        some = chosen(worlds, len(self._goal))
        return slice(None) if some is None else some

    def update(self, dt: float) -> None:
        """Move by a step of ``dt`` [s], and with the robot."""
        (low, high), most = self._device.range, self._device.max_speed
        way = np.where(self._towards, self._goal - self.position, self._goal)
        moved = self.position + dt * np.clip(way, -most, most)
        # one that starts outside of its range may only come back
        least, greatest = np.minimum(self.position, low), np.maximum(self.position, high)
        self.position = np.clip(moved, least, greatest)
        self.follow()

    def follow(self) -> None:
        """Move the device to the pose of its robot."""
        fleet, base = self._simulation.fleet, self._actuator.base
        pose = fleet.pose[:, self._robot.index]
        along, aside, z, yaw = self._offsets()
        turn = math.cos(base.yaw), math.sin(base.yaw)
        x = base.x + turn[0] * along - turn[1] * aside
        y = base.y + turn[1] * along + turn[0] * aside
        cos, sin = np.cos(pose[:, 2]), np.sin(pose[:, 2])
        where = np.stack(
            (
                pose[:, 0] + cos * x - sin * y,
                pose[:, 1] + sin * x + cos * y,
                pose[:, 2] + base.yaw + yaw,
            ),
            axis=1,
        )
        height = fleet.heights[:, self._robot.index] + base.z + z
        self._simulation.engine.place_body(self._actuator.body, where, height=height)

    def _offsets(self) -> tuple[Floats, Floats, Floats, Floats]:
        """Return the offset from its place at position zero, in the frame of that."""
        none = np.zeros_like(self.position)
        if self._device.type == "rotational":
            return none, none, none, self.position
        length = math.hypot(*self._device.axis)
        x, y, z = (self.position * (part / length if length else 0.0) for part in self._device.axis)
        return x, y, z, none

    def reset(self, worlds: Worlds | None = None) -> None:
        """Reset the actuator to its start."""
        which = self._rows(worlds)
        self.position[which] = self._device.start
        self._goal[which], self._towards[which] = 0.0, False
        self.follow()

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return all mutable state, to be read or written, each of shape (nworld,)."""
        return {"position": self.position, "goal": self._goal, "towards": self._towards}


def actuators_of(simulation: StageBodies) -> dict[int, list[Actuator]]:
    """Return the actuators of each robot that has some, by its index."""
    return {
        robot.index: [Actuator(simulation, robot, actuator) for actuator in robot.mounted_actuators]
        for robot in simulation.robots
        if robot.mounted_actuators
    }
