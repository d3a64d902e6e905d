"""Bases on driven wheels, some on the left and some on the right."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from typing import Any

from gazelle.array_types import Worlds
from gazelle.description.source import Source
from gazelle.errors import SimulationError
from gazelle.plugins.odometry import OdometryOutputs
from gazelle.plugins.wheel_motors import WheelMotors, WheelSystem
from gazelle.simulation import JointHandle, ModelPlugin, Robot, TwistInput


class Side(Enum):
    """Side of a wheel; the value is the sign of its share in turning left."""

    LEFT = -1.0
    RIGHT = 1.0


class WheeledDrive(ModelPlugin):
    """Gives the wheels of each side one speed, by motors of limited torque.

    Subclasses call ``drive``, ``listen`` and, if they publish, ``publish_odometry`` in ``load``.

    Attributes:
        odometry: Odometry output, if any.
        motors: Of the wheels.
    """

    system = WheelSystem
    odometry: OdometryOutputs | None = None
    motors: WheelMotors

    def drive(
        self,
        robot: Robot,
        wheels: Sequence[tuple[str, Side]],
        *,
        separation: float,
        diameter: float,
        torque: float,
        source: Source | None,
    ) -> None:
        """Add motors to the wheels.

        Args:
            robot: Has them.
            wheels: Names of joints, and their sides.
            separation: Between the sides [m].
            diameter: Of the wheels [m].
            torque: Of each motor at most [N m].
            source: Place of the numbers in the file.

        Raises:
            SimulationError: A joint is missing, or a length is not positive.
        """
        if separation <= 0.0 or diameter <= 0.0:
            raise SimulationError(
                "wheelSeparation and wheelDiameter must be positive", source=source
            )
        self._sides: dict[Side, list[JointHandle]] = {side: [] for side in Side}
        for name, side in wheels:
            self._sides[side].append(robot.joints[name])
            self._sides[side][-1].add_motor(torque)
        self._separation, self._radius = separation, diameter / 2.0

    def listen(self, robot: Robot, topic: str) -> None:
        """Open the port for commands."""
        self._command = robot.inputs["cmd_vel"] = TwistInput(robot.simulation.nworld, topic)
        self.motors = WheelMotors(
            robot,
            self._command,
            self._sides[Side.LEFT],
            self._sides[Side.RIGHT],
            separation=self._separation,
            radius=self._radius,
        )

    def publish_odometry(self, odometry: OdometryOutputs) -> None:
        """Publish the odometry at every update."""
        self.odometry = odometry
        self.published = (odometry,)

    def reset(self, worlds: Worlds | None) -> None:
        """Send the command to the motors again, which lost their speeds."""
        self.motors.forget(worlds)

    def restore(self, state: Any) -> None:
        """Send the command to the motors again."""
        del state
        self.reset(None)
