"""``turtlebot3_teleop_key``: a TurtleBot3 driven by five keys, its speeds changed step by step."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.interrupts import stopping
from gazelle_ros.base.output import say
from gazelle_ros.builtin.arguments import parse_arguments
from gazelle_ros.builtin.teleop.keyboard import CTRL_C, DOWN, LEFT, RIGHT, UP, Keyboard
from gazelle_ros.msgs import geometry_msgs

LIMITS = {"burger": (0.22, 2.84), "waffle": (0.26, 1.82), "waffle_pi": (0.26, 1.82)}
"""Greatest speeds of each model [m/s, rad/s], from its data sheet."""
_LINEAR_STEP, _ANGULAR_STEP = 0.01, 0.1
_PERIOD_S = 0.1
_HELP = """Drive a TurtleBot3 ({model}) with the keys

        w
   a    s    d
        x

w, x   faster forwards, faster backwards (at most {linear} m/s)
a, d   more to the left, more to the right (at most {angular} rad/s)
s, space   stop
The arrows do the same. Ctrl-C ends it.
"""


@dataclass(slots=True)
class StepwiseDrive:
    """Speeds that keys change, and that the robot is led to without jumps.

    Attributes:
        limits: Greatest speeds [m/s, rad/s].
        target: Speeds of the keys.
        sent: Speeds of the last command.
    """

    limits: tuple[float, float]
    target: tuple[float, float] = (0.0, 0.0)
    sent: tuple[float, float] = (0.0, 0.0)

    def press(self, key: str) -> bool:
        """Handle a key; False for keys without meaning."""
        forwards = {"w": 1, UP: 1, "x": -1, DOWN: -1}.get(key, 0)
        left = {"a": 1, LEFT: 1, "d": -1, RIGHT: -1}.get(key, 0)
        if key in {"s", " "}:
            self.target = self.sent = (0.0, 0.0)
            return True
        linear = self.target[0] + forwards * _LINEAR_STEP
        angular = self.target[1] + left * _ANGULAR_STEP
        self.target = (_bounded(linear, self.limits[0]), _bounded(angular, self.limits[1]))
        return bool(forwards or left)

    def advance(self) -> tuple[float, float]:
        """Advance the command towards its target; returns the command."""
        self.sent = (
            _towards(self.sent[0], self.target[0], _LINEAR_STEP / 2.0),
            _towards(self.sent[1], self.target[1], _ANGULAR_STEP / 2.0),
        )
        return self.sent


def main(arguments: Sequence[str]) -> int:
    """Drive until Ctrl-C; returns the exit code."""
    found = parse_arguments(arguments, "turtlebot3_teleop")
    with found.start() as node, Keyboard() as keyboard, stopping() as stop:
        node.on_shutdown.append(lambda _reason: stop.set())
        usual = os.environ.get("TURTLEBOT3_MODEL") or "burger"
        model = str(node.get_param("model", usual))
        if model not in LIMITS:
            raise RosError(
                f"there is no TurtleBot3 '{model}'", hint=f"there are: {', '.join(LIMITS)}"
            )
        drive = StepwiseDrive(LIMITS[model])
        twist = geometry_msgs.msg.Twist
        publisher = node.advertise("cmd_vel", twist, 10)
        linear, angular = drive.limits
        say(_HELP.format(model=model, linear=linear, angular=angular))
        try:
            while not stop.is_set():
                keys = keyboard.wait(_PERIOD_S)
                if keys is None or CTRL_C in keys:
                    break
                known = [drive.press(key) for key in keys]
                if any(known):
                    say("target: {:.2f} m/s, {:.2f} rad/s\n".format(*drive.target))
                publisher.publish(_message(twist, *drive.advance()))
        finally:
            if not node.closed:
                publisher.publish(twist())
    return 0


def _message(
    twist: type[geometry_msgs.msg.Twist], linear: float, angular: float
) -> geometry_msgs.msg.Twist:
    message = twist()
    message.linear.x, message.angular.z = linear, angular
    return message


def _bounded(value: float, limit: float) -> float:
    """Return a rounded value, so that as many steps back end at zero."""
    return round(min(max(value, -limit), limit), 6)


def _towards(now: float, target: float, step: float) -> float:
    return min(now + step, target) if target > now else max(now - step, target)
