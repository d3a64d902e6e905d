"""Bases on driven wheels, some on the left and some on the right."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from enum import Enum
from typing import Any

from gazelle.array_types import Worlds
from gazelle.description.source import Source
from gazelle.errors import SimulationError
from gazelle.native.system import System
from gazelle.plugins.odometry import OdometryOutputs, measure_wanted
from gazelle.plugins.wheel_motors import WheelMotors, wheels_together
from gazelle.simulation import BasePlugin, JointHandle, ModelPlugin, Odometry, Robot, TwistInput


class Side(Enum):
    """Where a wheel is; the value is the sign of its share in turning left."""

    LEFT = -1.0
    RIGHT = 1.0


class WheeledDrive(ModelPlugin):
    """Gives the wheels of each side one speed, by motors of limited torque.

    Subclasses call ``drive``, ``listen`` and, if they publish, ``tell`` in ``load``.

    Attributes:
        odometry: What is published, if anything is.
        motors: Of the wheels.
    """

    odometry: OdometryOutputs | None = None
    motors: WheelMotors

    def __init__(self) -> None:
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

    def tell(self, odometry: OdometryOutputs) -> None:
        """Publish the odometry at every update."""
        self.odometry = odometry

    @property
    def active(self) -> bool:
        """Whether it has a rate of its own, there is a new command, or anybody listens."""
        return bool(self.update_rate) or self._settled != self._command.revision or self.is_heard

    def kind(self) -> Hashable | None:
        """All of them."""
        return "WheeledDrive"

    @classmethod
    def together(cls, plugins: Sequence[WheeledDrive]) -> System | BasePlugin:
        """The wheels of many robots; commands are kept in tables of all from then on."""
        eager = bool(plugins[0].update_rate)
        return wheels_together([each.motors for each in plugins], eager=eager)

    @property
    def is_heard(self) -> bool:
        """Whether anybody listens to the odometry."""
        return self.odometry is not None and self.odometry.wanted

    @classmethod
    def measure_together(cls, plugins: Sequence[WheeledDrive]) -> list[Odometry | None]:
        """The odometry of all robots that somebody listens to."""
        return measure_wanted([each.odometry for each in plugins])

    def publish_measured(self, measured: Odometry | None = None) -> None:
        """Publish the odometry, which may have been measured already."""
        if self.odometry is not None:
            self.odometry.publish(measured)

    def on_update(self, time: float) -> None:  # noqa: ARG002  values carry their own stamps
        """Drive the wheels and publish."""
        if self._settled != self._command.revision:
            self._settled = self._command.revision
            self.motors.drive()
        self.publish_measured()

    def reset(self, worlds: Worlds | None) -> None:
        """The motors forgot their speeds: give them the command anew."""
        self.motors.forget(worlds)
        self._settled = -1

    def restore(self, state: Any) -> None:
        """Give the motors the command anew."""
        del state
        self.reset(None)
