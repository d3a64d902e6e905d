"""What controllers of wheeled bases have in common: odometry, commands that age, limits."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats, Ints64, Worlds
from gazelle.control.base_odometry import BaseOdometry
from gazelle.control.commands import rows_of
from gazelle.control.controller import Controller
from gazelle.control.measurements import Odometry, SixNumbers, Transform, Transforms
from gazelle.control.parameters import ControllerParameters
from gazelle.control.publishing import PublishingSchedule
from gazelle.control.speed_limiter import SpeedLimiter
from gazelle.control.values import BaseTwist, StampedTwist
from gazelle.errors import ControlError, ControlWarning
from gazelle.rotations import from_yaw

_NANOSECONDS = 1_000_000_000
AXES = ("linear/x", "linear/y", "angular/z")


class BaseController(Controller):
    """Drives a base as it is told, and tells where that leads.

    Subclasses say what their wheels measure (``advance``), and turn a velocity into commands
    (``drive``). The order of an update is that of the originals: odometry, publishing, command,
    limits, wheels. A command that is older than ``cmd_vel_timeout`` is one to stand still.
    """

    def open_base(self, parameters: ControllerParameters) -> None:
        """Read what all bases have, open the ports."""
        self._timeout_ns = round(parameters.number("cmd_vel_timeout", 0.5) * _NANOSECONDS)
        self._several = parameters.flag("allow_multiple_cmd_vel_publishers", default=True)
        self._open_loop = parameters.flag("open_loop", default=False)
        self._base = parameters.text("base_frame_id", "base_link")
        self._odom = parameters.text("odom_frame_id", "odom")
        self.framed = parameters.flag("enable_odom_tf", default=True)
        window = parameters.number("velocity_rolling_window_size", 10)
        self._pose_variance = _variance(parameters, "pose_covariance_diagonal")
        self._twist_variance = _variance(parameters, "twist_covariance_diagonal")
        self._limiters = [SpeedLimiter.read(parameters.part(axis)) for axis in AXES]
        self.odometry = BaseOdometry(self.nworld, int(window))
        self.schedule = PublishingSchedule(parameters.number("publish_rate", 50.0))
        zero = np.zeros((self.nworld, 3))
        self._wanted, self.last, self._earlier = zero.copy(), zero.copy(), zero.copy()
        self._stamps: Ints64 = np.zeros(self.nworld, np.int64)
        self._odom_port = self.add_output("odom", Odometry, self._measure, queue_size=100)
        self._frames_port = self.add_output(
            "tf", Transforms, self._frames, topic="/tf", queue_size=100
        )
        self._command_port = self.add_input("cmd_vel", BaseTwist, self._receive)
        self._out = None
        if parameters.flag("publish_cmd", default=False):
            self._out = self.add_output("cmd_vel_out", StampedTwist, self._driven, queue_size=100)

    # -- for subclasses ----------------------------------------------------------------

    def advance(self, period: float) -> bool:
        """Measure the wheels and go on with the odometry; whether they could be measured."""
        raise NotImplementedError

    def drive(self, twist: Floats, period: float) -> None:
        """Command the wheels for a velocity, forward, sideways and turning, shape (nworld, 3)."""
        raise NotImplementedError

    def stand(self, rows: Worlds) -> None:
        """Command the wheels to stand still in some worlds."""
        raise NotImplementedError

    def measure_anew(self, rows: Worlds) -> None:
        """Count from where the wheels are now in some worlds."""

    def published(self) -> None:
        """The odometry is out; publish what goes with it."""

    def command_speed(self, speed: float, rows: Worlds) -> None:
        """Be told to go forward at a speed [m/s] from now on."""
        self._wanted[rows] = (speed, 0.0, 0.0)
        self._stamps[rows] = self.now_ns

    def too_old(self) -> Bools:
        """Where the last command is too old, shape (nworld,)."""
        return self.now_ns - self._stamps > self._timeout_ns

    # -- commands ------------------------------------------------------------------------

    def _receive(self, twist: BaseTwist, worlds: Worlds | None) -> None:
        rows = self.rows(worlds)
        if not self.running:
            raise ControlError("can't accept new commands: controller is not running")
        if not self._several and self._command_port.publishers() > 1:
            self._brake(rows)
            raise ControlError(
                f"detected {self._command_port.publishers()} publishers on "
                f"'{self._command_port.topic}': only 1 publisher is allowed; going to brake",
                hint="set allow_multiple_cmd_vel_publishers",
            )
        linear = rows_of("linear velocity", twist.linear, 3, len(rows))
        angular = rows_of("angular velocity", twist.angular, 3, len(rows))
        wanted = np.stack((linear[:, 0], linear[:, 1], angular[:, 2]), axis=1)
        if not np.isfinite(wanted).all():
            text = f"controller '{self.name}' ignores a command that is not finite"
            warnings.warn(ControlWarning(text), stacklevel=3)
            return
        self._wanted[rows] = wanted
        self._stamps[rows] = self.now_ns

    def _brake(self, rows: Worlds) -> None:
        self.stand(rows)

    # -- the loop ----------------------------------------------------------------------

    def starting(self, time: float) -> None:  # noqa: ARG002  the manager's clock is exact
        """Stand still."""
        self._begin(np.arange(self.nworld))
        self.odometry.forget_velocity()
        self.schedule.start(self.now_ns, at_once=False)

    def _begin(self, rows: Worlds) -> None:
        self._brake(rows)
        self._wanted[rows] = 0.0
        self._stamps[rows] = self.now_ns
        self.measure_anew(rows)

    def stopping(self, time: float) -> None:  # noqa: ARG002  at any time
        """Stand still."""
        self._brake(np.arange(self.nworld))

    def update(self, time: float, period: float) -> None:  # noqa: ARG002  the clock is exact
        """Measure, publish, drive."""
        if self._open_loop:
            self.odometry.drive(self.last, period)
        elif not self.advance(period):
            return
        if self.schedule.is_due(self.now_ns):
            self._odom_port.publish()
            if self.framed:
                self._frames_port.publish()
            self.published()
        self.drive(self._limited(period), period)
        if self._out is not None:
            self._out.publish()

    def _limited(self, period: float) -> Floats:
        """What is driven now: commands that are not too old, within limits."""
        wanted = np.where(self.too_old()[:, None], 0.0, self._wanted)
        columns = [
            each.limit(wanted[:, i], self.last[:, i], self._earlier[:, i], period)
            for i, each in enumerate(self._limiters)
        ]
        self._earlier, self.last = self.last, np.stack(columns, axis=1)
        return self.last

    # -- telling -------------------------------------------------------------------------

    def _measure(self) -> Odometry:
        position, quaternion = self._place()
        twist, nothing = self.odometry.twist, np.zeros((self.nworld, 3))
        linear, angular = nothing.copy(), nothing.copy()
        linear[:, :2], angular[:, 2] = twist[:, :2], twist[:, 2]
        return Odometry(
            self.now_ns,
            self._odom,
            self._base,
            position,
            quaternion,
            linear,
            angular,
            self._pose_variance,
            self._twist_variance,
        )

    def _place(self) -> tuple[Floats, Floats]:
        position = self.odometry.pose.copy()
        position[:, 2] = 0.0
        return position, from_yaw(self.odometry.pose[:, 2])

    def _frames(self) -> Transforms:
        return Transforms(self.now_ns, (Transform(self._odom, self._base, *self._place()),))

    def _driven(self) -> StampedTwist:
        linear, angular = np.zeros((2, self.nworld, 3))
        linear[:, :2], angular[:, 2] = self.last[:, :2], self.last[:, 2]
        return StampedTwist(self.now_ns, self._base, linear, angular)

    # -- beginning anew --------------------------------------------------------------------

    def reset(self, worlds: Worlds | None) -> None:
        """Stand still at the origin of the odometry."""
        rows = self.rows(worlds)
        self.last[rows] = self._earlier[rows] = 0.0
        self.odometry.reset(worlds)
        if worlds is None:
            self.schedule.start(self.now_ns, at_once=False)
        if self.running:
            self._begin(rows)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Odometry and commands."""
        return {
            "wanted": self._wanted.copy(),
            "last": self.last.copy(),
            "earlier": self._earlier.copy(),
            "stamps": self._stamps.copy(),
            **self.schedule.state(),
            **{f"odometry/{name}": value for name, value in self.odometry.state().items()},
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        self._wanted, self.last = np.array(state["wanted"]), np.array(state["last"])
        self._earlier, self._stamps = np.array(state["earlier"]), np.array(state["stamps"])
        self.schedule.restore(state)
        names = ("pose", "twist", "recent")
        self.odometry.restore({name: state[f"odometry/{name}"] for name in names})


def _variance(parameters: ControllerParameters, name: str) -> SixNumbers:
    """Six floats; ints are refused, as the original ends its process at one."""
    given = parameters.get(name)
    if given is None:
        raise ControlError(
            f"there is no parameter '{parameters.place}/{name}'", hint="give six floats"
        )
    good = isinstance(given, list | tuple) and len(given) == 6
    if not good or not all(isinstance(each, float) and math.isfinite(each) for each in given):
        raise parameters.wrong(name, "six floats, such as 0.001 or 0.0 (not 0)", given)
    a, b, c, d, e, f = given
    return (a, b, c, d, e, f)
