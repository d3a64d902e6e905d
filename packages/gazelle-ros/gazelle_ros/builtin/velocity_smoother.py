"""The nodelet ``yocs_velocity_smoother``: commands within limits of acceleration (http://wiki.ros.org/yocs_velocity_smoother)."""

from __future__ import annotations

import logging
import threading
from collections import deque
from dataclasses import dataclass
from statistics import median_high

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.parameter_values import positive
from gazelle_ros.base.tuned_fields import tunable
from gazelle_ros.builtin.parameters import private_values, settings_of
from gazelle_ros.builtin.speeds import Speeds, repeat, twist_of
from gazelle_ros.builtin.tuned_settings import TunedSettings
from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import geometry_msgs, nav_msgs
from gazelle_ros.node import Node

NONE, ODOMETRY, COMMANDS = 0, 1, 2
_PERIODS = 5
_USUAL_PERIOD_S = 0.1
_SILENT_PERIODS, _SILENCE_S = 3.0, 0.5
_LOST_PERIODS = 5.0
_BUFFER = 2.0
"""Periods of acceleration by which a robot's speed may differ from the commands."""
_NEEDED = ("speed_lim_v", "speed_lim_w", "accel_lim_v", "accel_lim_w")
_LOG = logging.getLogger("gazelle.ros.velocity_smoother")


@dataclass(frozen=True, slots=True)
class SmootherSettings:
    """Parameters of ``yocs_velocity_smoother``.

    Attributes:
        speed_lim_v: Greatest linear speed [m/s].
        speed_lim_w: Greatest angular speed [rad/s].
        accel_lim_v: Greatest linear acceleration [m/s2].
        accel_lim_w: Greatest angular acceleration [rad/s2].
        decel_factor: Ratio of the greatest deceleration to that.
        frequency: Of the commands [Hz].
        quiet: Do not warn where the robot's own speed is used.
        robot_feedback: The robot's own speed: 0 none, 1 odometry, 2 commands behind a multiplexer.
    """

    speed_lim_v: float = tunable(1.0, 0.0, 10.0, "Maximum linear velocity")
    speed_lim_w: float = tunable(5.0, 0.0, 10.0, "Maximum angular velocity")
    accel_lim_v: float = tunable(0.5, 0.0, 10.0, "Maximum linear acceleration")
    accel_lim_w: float = tunable(2.5, 0.0, 10.0, "Maximum angular acceleration")
    decel_factor: float = tunable(1.0, 0.0, 10.0, "Deceleration to acceleration ratio")
    frequency: float = 20.0
    quiet: bool = False
    robot_feedback: int = NONE

    def bounded(self, speeds: Speeds) -> Speeds:
        """Return speeds within the limits of speed."""
        limits = (self.speed_lim_v, self.speed_lim_w)
        v, w = (min(max(each, -most), most) for each, most in zip(speeds, limits, strict=True))
        return v, w

    def next_command(self, last: Speeds, target: Speeds, robot: Speeds) -> Speeds:
        """Return the command after the last one, a period later, on the way to a target.

        The change keeps its direction: where one speed cannot change as fast as wanted, the other
        waits for it.

        Args:
            last: The last command.
            target: Speeds to reach.
            robot: The robot's own speeds; with odometry, one against the target brakes.
        """
        changes = [there - here for here, there in zip(last, target, strict=True)]
        limits = [
            self._limit(accel, *each)
            for accel, each in zip(
                (self.accel_lim_v, self.accel_lim_w),
                zip(changes, target, robot, strict=True),
                strict=True,
            )
        ]
        parts = [most / abs(each) for each, most in zip(changes, limits, strict=True) if each]
        part = min(1.0, *parts) if parts else 1.0
        if part == 1.0:
            return target
        v, w = (here + part * each for here, each in zip(last, changes, strict=True))
        return v, w

    def _limit(self, accel: float, change: float, target: float, robot: float) -> float:
        """Return the greatest change of a speed within a period."""
        against = self.robot_feedback == ODOMETRY and robot * target < 0.0
        braking = against or change * target <= 0.0
        return accel * (self.decel_factor if braking else 1.0) / self.frequency

    def strays(self, last: Speeds, robot: Speeds) -> bool:
        """Return whether the robot's own speeds are far from the last command."""
        period = _BUFFER / self.frequency
        return any(
            not -accel * self.decel_factor * period <= own - said <= accel * period
            for accel, own, said in zip(
                (self.accel_lim_v, self.accel_lim_w), robot, last, strict=True
            )
        )


class VelocitySmoother:
    """Commands of ``~raw_cmd_vel`` on ``~smooth_cmd_vel``, within limits of speed and acceleration.

    Args:
        node: On the graph.

    Raises:
        Error: A limit is missing, or a parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        values = private_values(node)
        missing = [name for name in _NEEDED if name not in values]
        if missing:
            raise RosError(f"the parameter {node.resolve('~' + missing[0])} is not set")
        self.settings = _checked(settings_of(node, SmootherSettings))
        self._lock = threading.Lock()
        self._target = self._last = self._robot = (0.0, 0.0)
        self._periods: deque[float] = deque(maxlen=_PERIODS)
        self._received_at = 0
        self._active = False
        twist = geometry_msgs.msg.Twist
        self._output = node.advertise("~smooth_cmd_vel", twist, queue_size=1)
        node.subscribe("~odometry", nav_msgs.msg.Odometry, self._take_odometry, 1)
        node.subscribe("~robot_cmd_vel", twist, self._take_robot, 1)
        node.subscribe("~raw_cmd_vel", twist, self.take, 1)
        self._tuned = TunedSettings(node, self.settings, self._change)

    def run(self, stop: threading.Event) -> None:
        """Publish commands until shutdown."""
        repeat(self._node, self.settings.frequency, self._publish, stop)

    def take(self, message: geometry_msgs.msg.Twist) -> None:
        """Handle a command."""
        with self._lock:
            now = self._node.clock.now()
            self._periods.append((now - self._received_at) / SECOND)
            self._received_at, self._active = now, True
            self._target = self.settings.bounded((message.linear.x, message.angular.z))

    def step(self) -> Speeds | None:
        """Return the next command; None while there is nothing to do."""
        with self._lock:
            silent = (self._node.clock.now() - self._received_at) / SECOND
            usual = self._usual_period()
            if self._active and usual > 0.0 and silent > min(_SILENT_PERIODS * usual, _SILENCE_S):
                self._active = False
                if self._target != (0.0, 0.0):
                    _LOG.warning("commands ended with %g m/s, %g rad/s: braking", *self._target)
                    self._target = (0.0, 0.0)
            if self._active and usual > 0.0 and self.settings.robot_feedback != NONE:
                self._follow_robot(silent > _LOST_PERIODS * usual)
            if self._target != self._last:
                self._last = self.settings.next_command(self._last, self._target, self._robot)
            elif not self._active:
                return None
            return self._last

    def _publish(self) -> None:
        found = self.step()
        if found is not None:
            self._output.publish(twist_of(found))

    def _follow_robot(self, lost: bool) -> None:  # noqa: FBT001  # private
        """Continue from the robot's own speeds where it does not follow the commands."""
        if lost or self.settings.strays(self._last, self._robot):
            if not self.settings.quiet:
                _LOG.warning(
                    "the robot moves at %g m/s, %g rad/s, unlike the commands", *self._robot
                )
            self._last = self._robot

    def _usual_period(self) -> float:
        """Return the time between commands [s]: the median, or a guess after the first ones."""
        few = len(self._periods) <= _PERIODS // 2
        return _USUAL_PERIOD_S if few else median_high(self._periods)

    def _take_odometry(self, message: nav_msgs.msg.Odometry) -> None:
        if self.settings.robot_feedback == ODOMETRY:
            twist = message.twist.twist
            self._robot = (twist.linear.x, twist.angular.z)

    def _take_robot(self, message: geometry_msgs.msg.Twist) -> None:
        if self.settings.robot_feedback == COMMANDS:
            self._robot = (message.linear.x, message.angular.z)

    def _change(self, settings: SmootherSettings) -> None:
        with self._lock:
            self.settings = settings


def _checked(settings: SmootherSettings) -> SmootherSettings:
    positive("frequency", settings.frequency)
    if settings.robot_feedback not in {NONE, ODOMETRY, COMMANDS}:
        raise RosError(f"robot_feedback must be 0, 1 or 2, not {settings.robot_feedback}")
    return settings
