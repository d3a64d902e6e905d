"""What turns driven wheels as velocity commands say: of one robot, or of many at once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.errors import SimulationError
from gazelle.native.system import System
from gazelle.plugins.diff_drive_law import DiffDriveLaw, WheelTables
from gazelle.simulation import BasePlugin, JointArray, JointHandle, Robot, TwistInput


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
        self._own: WheelGroup | None = None
        self._native: tuple[int, DiffDriveLaw] | None = None

    def join(self, tables: WheelTables) -> None:
        """Keep what was told and is remembered in other tables of one drive from now on."""
        tables.take_over(self.tables)
        self.tables = tables
        self._command.keep_in(tables.linear[:, 0], tables.angular[:, 0])
        self._own = self._native = None

    def drive(self) -> None:
        """Give this robot's motors their speeds of this moment."""
        if self._own is None:
            self._own = WheelGroup([self])
        self._own.tell()

    def system(self) -> System | None:
        """What drives this robot's wheels without Python; None where the engine does not run it."""
        engine = self.robot.simulation.native
        if engine is None:
            return None
        if self._native is None or self._native[0] != engine.revision:
            self._native = engine.revision, native_law([self])
        return self._native[1]

    def forget(self, worlds: Worlds | None) -> None:
        """The motors forgot what they were told in some worlds; all if None."""
        self.tables.sent[slice(None) if worlds is None else worlds] = np.nan


def wheels_together(motors: Sequence[WheelMotors], *, eager: bool) -> System | BasePlugin:
    """What drives the wheels of some robots, in native code if their engine runs it.

    Args:
        motors: Of each robot.
        eager: Whether Python is to update it when nothing was commanded, too.
    """
    if motors[0].robot.simulation.native is None:
        return WheelGroup(motors, eager=eager)
    return native_law(motors)


def native_law(motors: Sequence[WheelMotors]) -> DiffDriveLaw:
    """The law of some robots, which gives the engine's motors their speeds."""
    engine = motors[0].robot.simulation.native
    if engine is None:
        raise SimulationError("the engine's motors are not to be driven by systems now")
    tables, law = _gather(motors)
    found = [
        [[engine.motor_targets(wheel.name) for wheel in side] for side in each.sides]
        for each in motors
    ]
    targets = next(targets for robot in found for side in robot for targets, _ in side)
    law.send_to(targets, [[[at for _, at in side] for side in robot] for robot in found])
    tables.sent[:] = np.nan  # it does not say what it sends
    return law


def _gather(motors: Sequence[WheelMotors]) -> tuple[WheelTables, DiffDriveLaw]:
    """Tables of some robots, which have joined them, and the law that goes by them."""
    tables = WheelTables.empty(motors[0].robot.simulation.nworld, len(motors))
    for part, each in enumerate(motors):
        each.join(tables.column(part))
    law = DiffDriveLaw(
        tables,
        separation=[each.separation for each in motors],
        radius=[each.radius for each in motors],
        acceleration=[each.acceleration for each in motors],
    )
    return tables, law


class WheelGroup(BasePlugin):
    """Drives the wheels of some robots from Python, telling motors what is new to them.

    Args:
        motors: Of each robot.
        eager: Whether it is to be updated when nothing was commanded, too.
    """

    def __init__(self, motors: Sequence[WheelMotors], *, eager: bool = True) -> None:
        simulation = motors[0].robot.simulation
        self._clock = simulation.clock
        self._tables, self._law = _gather(motors)
        self._eager = eager or any(each.acceleration > 0.0 for each in motors)
        wheels = [
            (wheel, 2 * part + side)
            for part, each in enumerate(motors)
            for side in (0, 1)
            for wheel in each.sides[side]
        ]
        self._joints = JointArray([wheel for wheel, _ in wheels])
        self._columns = np.array([column for _, column in wheels], np.intp)
        self._wanted: Floats = np.zeros((simulation.nworld, 2 * len(motors)))
        sides = [[[2 * part], [2 * part + 1]] for part in range(len(motors))]
        self._law.send_to(self._wanted, sides)
        self._followed: Floats | None = None

    @property
    def active(self) -> bool:
        """Whether it is eager, a command is new, or motors forgot theirs."""
        if self._eager or self._followed is None or np.isnan(self._tables.sent).any():
            return True
        return not np.array_equal(self._followed, self._commands())

    def _commands(self) -> Floats:
        return np.stack((self._tables.linear[..., 0], self._tables.angular[..., 2]))

    def on_update(self, time: float) -> None:  # noqa: ARG002  the clock knows it exactly
        """Drive."""
        self.tell()

    def tell(self) -> None:
        """Bring the law to this moment, and tell the motors."""
        self._law.bring(0, self._wanted.size // 2, self._clock.now_ns)
        if not self._eager:
            self._followed = self._commands()
        sent = self._tables.sent
        wanted = self._wanted.reshape(sent.shape)
        changed = (wanted != sent).any(axis=(0, 2))
        if not changed.any():
            return
        sent[:] = wanted
        chosen = None if changed.all() else changed[self._columns // 2]
        self._joints.drive(self._wanted[:, self._columns], chosen)
