"""Motors that turn driven wheels by velocity commands: of one robot, or of many at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from gazelle.array_types import Worlds
from gazelle.plugins.diff_drive_law import DiffDriveLaw, WheelTables
from gazelle.plugins.odometry import OdometryPlugin, OdometrySystem
from gazelle.simulation import JointHandle, Robot, TwistInput


class WheelMotors:
    """The motors of a robot's wheels; see ``DiffDriveLaw``.

    Args:
        robot: Has them.
        command: Its command.
        left: Wheels on the left, with motors.
        right: Wheels on the right, likewise.
        separation: Between the sides [m].
        radius: Of the wheels [m].
        acceleration: Most change of a wheel's speed on the ground [m/s²]; 0 for no limit.

    Attributes:
        tables: Commands, speeds and times, of one drive; a column of a group's.
    """

    def __init__(
        self,
        robot: Robot,
        command: TwistInput,
        left: Sequence[JointHandle],
        right: Sequence[JointHandle],
        *,
        separation: float,
        radius: float,
        acceleration: float = 0.0,
    ) -> None:
        self.robot, self._command, self.sides = robot, command, (tuple(left), tuple(right))
        self.separation, self.radius, self.acceleration = separation, radius, acceleration
        self.tables = WheelTables.empty(robot.simulation.nworld, 1)
        self.tables.last_ns[:] = robot.simulation.clock.now_ns

    def join(self, tables: WheelTables) -> None:
        """Store commands and memory in other tables of one drive from now on."""
        tables.copy_from(self.tables)
        self.tables = tables
        self._command.store_in(tables.linear[:, 0], tables.angular[:, 0])

    def forget(self, worlds: Worlds | None) -> None:
        """Discard the motors' commands in some worlds; all if None."""
        self.tables.sent[slice(None) if worlds is None else worlds] = np.nan


def wheel_law(motors: Sequence[WheelMotors]) -> DiffDriveLaw:
    """Return the law of some robots, which writes the speeds that the engine's motors hold.

    Commands and speeds are in tables of all from then on.

    Args:
        motors: Of each robot.
    """
    simulation = motors[0].robot.simulation
    tables = WheelTables.empty(simulation.nworld, len(motors))
    for part, each in enumerate(motors):
        each.join(tables.column(part))
    law = DiffDriveLaw(
        tables,
        separation=[each.separation for each in motors],
        radius=[each.radius for each in motors],
        acceleration=[each.acceleration for each in motors],
    )
    wheels = [
        (wheel.name, 2 * part + side)
        for part, each in enumerate(motors)
        for side in (0, 1)
        for wheel in each.sides[side]
    ]
    rows = simulation.engine.joints[tuple(name for name, _ in wheels)]
    targets, columns = rows.motor_targets()
    law.send_to(targets, columns, np.array([side for _, side in wheels], np.intp))
    return law


class WheelPlugin(OdometryPlugin, Protocol):
    """A drive of two sides."""

    motors: WheelMotors


class WheelSystem(OdometrySystem[WheelPlugin]):
    """Drives of two sides; their law runs in steps without subscribers.

    Args:
        plugins: The drives.
    """

    def __init__(self, plugins: Sequence[WheelPlugin]) -> None:
        super().__init__(plugins)
        self.kernel = wheel_law([each.motors for each in plugins])
