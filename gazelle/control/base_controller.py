"""Common base of controllers of wheeled bases: odometry, command timeouts, limits."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.control.base_law import BaseLaw, BaseMemory
from gazelle.control.base_odometry import BaseOdometry
from gazelle.control.commands import rows_of
from gazelle.control.control_law import ControlLaw
from gazelle.control.controller import Controller
from gazelle.control.measurements import Odometry, SixNumbers, Transform, Transforms
from gazelle.control.parameters import ControllerParameters
from gazelle.control.ports import StatePort
from gazelle.control.publishing import PublishingSchedule
from gazelle.control.speed_limiter import SpeedLimiter
from gazelle.control.values import BaseTwist, StampedTwist
from gazelle.engines.limits import NANOSECONDS
from gazelle.errors import ControlError, ControlWarning
from gazelle.rotations import from_yaw

AXES = ("linear/x", "linear/y", "angular/z")
_KEPT = ("desired", "stamps", "last", "earlier")


class BaseController(Controller):
    """Drives a base by commands, and publishes its odometry.

    The ``BaseLaw`` of a subclass (``drive_by``) knows the wheels: it advances the odometry, holds
    the command within limits, and turns wheels, without Python without subscribers. A command that is
    older than ``cmd_vel_timeout`` is one to stand still.
    """

    _law: BaseLaw

    def open_base(self, parameters: ControllerParameters) -> None:
        """Read what all bases have, open the ports."""
        self._several = parameters.flag("allow_multiple_cmd_vel_publishers", default=True)
        self._base = parameters.text("base_frame_id", "base_link")
        self._odom = parameters.text("odom_frame_id", "odom")
        window = parameters.number("velocity_rolling_window_size", 10)
        self._pose_variance = _variance(parameters, "pose_covariance_diagonal")
        self._twist_variance = _variance(parameters, "twist_covariance_diagonal")
        limiters = [SpeedLimiter.read(parameters.part(axis)) for axis in AXES]
        self.odometry = BaseOdometry(self.nworld, int(window))
        self.schedule = PublishingSchedule(parameters.number("publish_rate", 50.0))
        self.memory = BaseMemory.empty(self.nworld)
        self._columns: dict[str, NDArray[Any]] = {}
        self.law_arguments = (
            self.memory,
            self.odometry.law,
            np.array([each.bounds for each in limiters]),
            round(parameters.number("cmd_vel_timeout", 0.5) * NANOSECONDS),
        )
        self.open_loop = parameters.flag("open_loop", default=False)
        self.period = 0.0
        odom = self.add_output("odom", Odometry, self._measure, queue_size=100)
        self._published: list[StatePort[Any]] = [odom]
        self._prompt: list[StatePort[Any]] = []
        self._frames_port = self.add_output(
            "tf", Transforms, self._frames, topic="/tf", queue_size=100
        )
        self.publish_frames(enabled=parameters.flag("enable_odom_tf", default=True))
        self._command_port = self.add_input("cmd_vel", BaseTwist, self._receive)
        if parameters.flag("publish_cmd", default=False):
            self.publish_always(
                self.add_output("cmd_vel_out", StampedTwist, self._driven, queue_size=100)
            )

    def drive_by(self, law: BaseLaw) -> None:
        """Set the native law, made of ``law_arguments`` and ``open_loop``."""
        self._law = law

    def publish_with_odometry(self, port: StatePort[Any]) -> None:
        """Publish something besides whenever the odometry is."""
        self._published.append(port)

    @property
    def framed(self) -> bool:
        """True if the frame of the odometry is published, too."""
        return self._frames_port in self._published

    def publish_frames(self, *, enabled: bool) -> None:
        """Enable or disable publishing of the odometry frame."""
        if enabled and not self.framed:
            self._published.append(self._frames_port)
        elif self.framed and not enabled:
            self._published.remove(self._frames_port)

    def publish_always(self, port: StatePort[Any]) -> None:
        """Publish something after every update."""
        self._prompt.append(port)

    # -- for subclasses ----------------------------------------------------------------

    def column(self, name: str, *shape: int, kind: type[Any] = float) -> NDArray[Any]:
        """Return zeros, shape (nworld, ...), that belong to the state of the controller."""
        self._columns[name] = np.zeros((self.nworld, *shape), kind)
        return self._columns[name]

    def stand(self, rows: Worlds) -> None:
        """Command the wheels to stand still in some worlds."""
        raise NotImplementedError

    def remeasure(self, rows: Worlds) -> None:
        """Count from where the wheels are now in some worlds."""

    def command_speed(self, speed: float, rows: Worlds) -> None:
        """Command a forward speed [m/s]."""
        self.memory.desired[rows] = (speed, 0.0, 0.0)
        self.memory.stamps[rows] = self.now_ns

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
        velocities = np.stack((linear[:, 0], linear[:, 1], angular[:, 2]), axis=1)
        if not np.isfinite(velocities).all():
            text = f"controller '{self.name}' ignores a command that is not finite"
            warnings.warn(ControlWarning(text), stacklevel=3)
            return
        self.memory.desired[rows] = velocities
        self.memory.stamps[rows] = self.now_ns

    def _brake(self, rows: Worlds) -> None:
        self.stand(rows)

    # -- the loop ----------------------------------------------------------------------

    def starting(self, time: float) -> None:  # noqa: ARG002  the manager's clock is exact
        """Stop the base."""
        self._begin(np.arange(self.nworld))
        self.odometry.forget_velocity()
        self.schedule.start(self.now_ns, at_once=False)

    def _begin(self, rows: Worlds) -> None:
        self._brake(rows)
        self.memory.desired[rows] = 0.0
        self.memory.stamps[rows] = self.now_ns
        self.remeasure(rows)

    def stopping(self, time: float) -> None:  # noqa: ARG002  at any time
        """Stop the base."""
        self._brake(np.arange(self.nworld))

    def update(self, time: float, period: float) -> None:  # noqa: ARG002  the clock is exact
        """Update odometry and command; does nothing if a wheel cannot be measured."""
        self.period = period
        self._law.act(self.now_ns, period)
        if self.memory.lost.all():
            return
        if self.schedule.is_due(self.now_ns):
            for port in self._published:
                port.publish()
        for port in self._prompt:
            port.publish()

    def law(self) -> ControlLaw:
        """Return the native law, which does all but publishing."""
        return self._law

    def wake_ns(self) -> float:
        """Return the next time to publish, if there are subscribers."""
        for port in self._prompt:
            if port.has_subscribers:
                return 0.0
        for port in self._published:
            if port.has_subscribers:
                return self.schedule.next_ns
        return math.inf

    def catch_up(self, updates: int, period: float) -> None:
        """Advance the schedule past native updates: nothing had subscribers."""
        self.period = period
        self.schedule.skip(self.now_ns, updates)

    # -- publishing ----------------------------------------------------------------------

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
        driven = self.memory.last
        linear[:, :2], angular[:, 2] = driven[:, :2], driven[:, 2]
        return StampedTwist(self.now_ns, self._base, linear, angular)

    # -- restarting --------------------------------------------------------------------

    def reset(self, worlds: Worlds | None) -> None:
        """Reset the odometry to its origin, at rest."""
        rows = self.rows(worlds)
        self.memory.last[rows] = self.memory.earlier[rows] = 0.0
        self.odometry.reset(worlds)
        if worlds is None:
            self.schedule.start(self.now_ns, at_once=False)
        if self.running:
            self._begin(rows)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return odometry, commands and columns."""
        kept = {name: getattr(self.memory, name).copy() for name in _KEPT}
        return {
            **kept,
            **{name: array.copy() for name, array in self._columns.items()},
            **self.schedule.state(),
            **{f"odometry/{name}": value for name, value in self.odometry.state().items()},
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        for name in _KEPT:
            getattr(self.memory, name)[:] = state[name]
        for name, array in self._columns.items():
            array[:] = state[name]
        self.schedule.restore(state)
        names = self.odometry.state()
        self.odometry.restore({name: state[f"odometry/{name}"] for name in names})


def _variance(parameters: ControllerParameters, name: str) -> SixNumbers:
    """Return six floats; ints are rejected, as the original ends its process at one."""
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
