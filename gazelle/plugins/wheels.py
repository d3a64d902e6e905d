"""Bases on driven wheels, some on the left and some on the right."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from enum import Enum
from typing import Any

from gazelle.array_types import Floats, Worlds
from gazelle.description.source import Source
from gazelle.errors import SimulationError
from gazelle.native.system import System
from gazelle.plugins.diff_drive_law import DiffDriveLaw, WheelTables
from gazelle.plugins.odometry import OdometryOutputs, measure_wanted
from gazelle.simulation import JointHandle, ModelPlugin, Odometry, Robot, TwistInput


class Side(Enum):
    """Where a wheel is; the value is the sign of its share in turning left."""

    LEFT = -1.0
    RIGHT = 1.0


class WheeledDrive(ModelPlugin):
    """Gives the wheels of each side one speed, by motors of limited torque.

    Subclasses call ``drive``, ``listen`` and, if they publish, ``tell`` in ``load``.

    Attributes:
        odometry: What is published, if anything is.
        half: Half the distance between the sides [m].
        radius: Of the wheels [m].
    """

    odometry: OdometryOutputs | None = None
    half: float
    radius: float

    def __init__(self) -> None:
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
        self._robot = robot
        self.half, self.radius = separation / 2.0, diameter / 2.0
        self._wheels = [(robot.joints[name], side) for name, side in wheels]
        for wheel, _ in self._wheels:
            wheel.add_motor(torque)

    def listen(self, robot: Robot, topic: str) -> None:
        """Open the port for commands."""
        self._command = robot.inputs["cmd_vel"] = TwistInput(robot.simulation.nworld, topic)

    def tell(self, odometry: OdometryOutputs) -> None:
        """Publish the odometry at every update."""
        self.odometry = odometry

    @property
    def active(self) -> bool:
        """Whether it has a rate of its own, there is a new command, or anybody listens."""
        return bool(self.update_rate) or self._settled != self._command.revision or self.is_heard

    def kind(self) -> Hashable | None:
        """All of them."""
        return None if self._robot.simulation.native is None else "DiffDriveLaw"

    @classmethod
    def together(cls, plugins: Sequence[WheeledDrive]) -> System:
        """The wheels of many robots; commands are kept in arrays of all from then on."""
        simulation = plugins[0].robot.simulation
        tables = WheelTables.empty(simulation.nworld, len(plugins))
        for part, each in enumerate(plugins):
            each.keep_in(tables.linear[:, part], tables.angular[:, part])
        law = DiffDriveLaw(
            tables,
            separation=[2.0 * each.half for each in plugins],
            radius=[each.radius for each in plugins],
            acceleration=[0.0] * len(plugins),
        )
        wheels = [each.motors() for each in plugins]
        law.send_to(wheels[0][0], [columns for _, columns in wheels])
        return law

    @property
    def robot(self) -> Robot:
        """What is driven."""
        return self._robot

    def keep_in(self, linear: Floats, angular: Floats) -> None:
        """Keep commands in other arrays, shape (nworld, 3) each."""
        self._command.keep_in(linear, angular)
        self._settled = -1

    def motors(self) -> tuple[Floats, list[list[int]]]:
        """Where the engine keeps motors' velocities, and the columns of left and right wheels."""
        engine = self._robot.simulation.native
        if engine is None:
            raise SimulationError("the engine's motors are not to be driven by systems now")
        found = [(engine.motor_targets(wheel.name), side) for wheel, side in self._wheels]
        sides = [[at for (_, at), each in found if each is side] for side in Side]
        return found[0][0][0], sides

    @property
    def is_heard(self) -> bool:
        """Whether anybody listens to the odometry."""
        return self.odometry is not None and self.odometry.wanted

    @classmethod
    def measure_together(cls, plugins: Sequence[WheeledDrive]) -> list[Odometry | None]:
        """The odometry of all robots that somebody listens to."""
        return measure_wanted([each.odometry for each in plugins if each.odometry is not None])

    def publish_measured(self, measured: Odometry | None = None) -> None:
        """Publish the odometry, which may have been measured already."""
        if self.odometry is not None:
            self.odometry.publish(measured)

    def on_update(self, time: float) -> None:  # noqa: ARG002  values carry their own stamps
        """Drive the wheels and publish."""
        if self._settled != self._command.revision:
            self._settled = self._command.revision
            forward, turning = self._command.linear[:, 0], self._command.angular[:, 2]
            for wheel, side in self._wheels:
                wheel.drive((forward + side.value * turning * self.half) / self.radius)
        self.publish_measured()

    def reset(self, worlds: Worlds | None) -> None:
        """The motors forgot their speeds: give them the command anew."""
        del worlds
        self._settled = -1

    def restore(self, state: Any) -> None:
        """Give the motors the command anew."""
        del state
        self._settled = -1
