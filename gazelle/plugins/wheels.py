"""Bases on driven wheels, some on the left and some on the right."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from typing import Any

from gazelle.array_types import Worlds
from gazelle.description.source import Source
from gazelle.errors import SimulationError
from gazelle.plugins.publishing import Published
from gazelle.simulation import JointHandle, ModelPlugin, Robot, TwistInput


class Side(Enum):
    """Where a wheel is; the value is the sign of its share in turning left."""

    LEFT = -1.0
    RIGHT = 1.0


class WheeledDrive(ModelPlugin):
    """Gives the wheels of each side one speed, by motors of limited torque.

    Subclasses call ``drive``, ``listen`` and ``publish`` in ``load``.
    """

    def __init__(self) -> None:
        self._published: list[Published] = []
        self._wheels: list[tuple[JointHandle, Side]] = []
        self._settled = -1  # the command whose speeds the motors already have

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
        """Put motors on the wheels.

        Args:
            robot: Has them.
            wheels: Names of joints, and their sides.
            separation: Between the sides [m].
            diameter: Of the wheels [m].
            torque: Of each motor at most [N m].
            source: Where the numbers stand.

        Raises:
            SimulationError: A joint is missing, or a length is not positive.
        """
        if separation <= 0.0 or diameter <= 0.0:
            raise SimulationError(
                "wheelSeparation and wheelDiameter must be positive", source=source
            )
        self._half, self._radius = separation / 2.0, diameter / 2.0
        self._wheels = [(robot.joints[name], side) for name, side in wheels]
        for wheel, _ in self._wheels:
            wheel.add_motor(torque)

    def listen(self, robot: Robot, topic: str) -> None:
        """Open the port for commands."""
        self._command = robot.inputs["cmd_vel"] = TwistInput(robot.simulation.nworld, topic)

    def publish(self, output: Published) -> None:
        """Publish something at every update."""
        self._published.append(output)

    @property
    def active(self) -> bool:
        """Whether there is a new command, or anybody listens."""
        return self._settled != self._command.revision or any(o.wanted for o in self._published)

    def on_update(self, time: float) -> None:  # noqa: ARG002  values carry their own stamps
        """Drive the wheels and publish."""
        if self._settled != self._command.revision:
            self._settled = self._command.revision
            forward, turning = self._command.linear[:, 0], self._command.angular[:, 2]
            for wheel, side in self._wheels:
                wheel.drive((forward + side.value * turning * self._half) / self._radius)
        for output in self._published:
            output.publish()

    def reset(self, worlds: Worlds | None) -> None:
        """The motors forgot their speeds: give them the command anew."""
        del worlds
        self._settled = -1

    def restore(self, state: Any) -> None:
        """Give the motors the command anew."""
        del state
        self._settled = -1
