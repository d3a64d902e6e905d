"""What turns driven wheels as velocity commands say: of one robot, or of many at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.plugins.diff_drive_law import DiffDriveLaw, WheelTables
from gazelle.plugins.odometry import OdometryPlugin, OdometrySystem
from gazelle.simulation import JointArray, JointHandle, Robot, TwistInput


class WheelMotors:
    """The motors of a robot's wheels; see ``DiffDriveLaw``.

    Args:
        robot: Has them.
        command: What it is told.
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
        """Keep what was told and is remembered in other tables of one drive from now on."""
        tables.take_over(self.tables)
        self.tables = tables
        self._command.keep_in(tables.linear[:, 0], tables.angular[:, 0])

    def forget(self, worlds: Worlds | None) -> None:
        """The motors forgot what they were told in some worlds; all if None."""
        self.tables.sent[slice(None) if worlds is None else worlds] = np.nan


class Wheels:
    """The wheels of some robots, driven by one law; commands and speeds are in tables of all.

    Args:
        motors: Of each robot.
        eager: Whether ``tell`` is needed when nothing was commanded, too.

    Attributes:
        law: What drives them.
    """

    def __init__(self, motors: Sequence[WheelMotors], *, eager: bool = True) -> None:
        self._simulation = motors[0].robot.simulation
        self._tables = WheelTables.empty(self._simulation.nworld, len(motors))
        for part, each in enumerate(motors):
            each.join(self._tables.column(part))
        self.law = DiffDriveLaw(
            self._tables,
            separation=[each.separation for each in motors],
            radius=[each.radius for each in motors],
            acceleration=[each.acceleration for each in motors],
        )
        self._eager = eager or any(each.acceleration > 0.0 for each in motors)
        wheels = [
            (wheel, 2 * part + side)
            for part, each in enumerate(motors)
            for side in (0, 1)
            for wheel in each.sides[side]
        ]
        self._names = tuple(wheel.name for wheel, _ in wheels)
        self._joints = JointArray([wheel for wheel, _ in wheels])
        self._columns = np.array([column for _, column in wheels], np.intp)
        self._followed: Floats | None = None

    def bind(self) -> DiffDriveLaw | None:
        """Return the law that writes the engine's motors itself; None where it cannot."""
        engine = self._simulation.native
        if engine is None:
            return None
        targets, columns = engine.joints[self._names].motor_targets()
        self.law.send_to(targets, columns, self._columns)
        return self.law

    @property
    def waiting(self) -> bool:
        """Whether they are eager, a command is new, or motors forgot theirs."""
        if self._eager or self._followed is None or np.isnan(self._tables.sent).any():
            return True
        return not np.array_equal(self._followed, self._commands())

    def _commands(self) -> Floats:
        return np.stack((self._tables.linear[..., 0], self._tables.angular[..., 2]))

    def tell(self) -> None:
        """Bring the law to this moment, and tell the motors what is new to them."""
        sent = self._tables.sent
        before = sent.copy()
        self.law.bring(0, self._tables.last_ns.size, self._simulation.clock.now_ns)
        if not self._eager:
            self._followed = self._commands()
        changed = (sent != before).any(axis=(0, 2))
        if changed.any():
            chosen = None if changed.all() else changed[self._columns // 2]
            self._joints.drive(sent.reshape(len(sent), -1)[:, self._columns], chosen)


class WheelPlugin(OdometryPlugin, Protocol):
    """A drive of two sides."""

    update_rate: float | None
    motors: WheelMotors


class WheelSystem(OdometrySystem[WheelPlugin]):
    """Drives of two sides, whose law runs in steps where nobody has subscribed.

    Args:
        plugins: The drives.
    """

    def __init__(self, plugins: Sequence[WheelPlugin]) -> None:
        super().__init__(plugins)
        self._wheels = Wheels([each.motors for each in plugins], eager=bool(plugins[0].update_rate))
        self.kernel = self._wheels.bind()

    @property
    def active(self) -> bool:
        """Whether motors have to be told anything."""
        return self._wheels.waiting

    def update(self, time: float) -> None:  # noqa: ARG002  the clock knows it exactly
        """Drive."""
        self._wheels.tell()
