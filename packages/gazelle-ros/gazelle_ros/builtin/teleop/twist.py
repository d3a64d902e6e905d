"""``teleop_twist_keyboard``: any robot that takes a twist, driven by keys around ``k``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from gazelle_ros.base.interrupts import stopping
from gazelle_ros.base.output import say
from gazelle_ros.builtin.arguments import parse_arguments
from gazelle_ros.builtin.teleop.keyboard import CTRL_C, Keyboard
from gazelle_ros.messages import load_message
from gazelle_ros.msgs import geometry_msgs
from gazelle_ros.node import Node
from gazelle_ros.time import Time

_LOOK_S = 0.1
_MOVES = {
    "i": (1, 0, 0, 0), "o": (1, 0, 0, -1), "j": (0, 0, 0, 1), "l": (0, 0, 0, -1),
    "u": (1, 0, 0, 1), ",": (-1, 0, 0, 0), ".": (-1, 0, 0, 1), "m": (-1, 0, 0, -1),
    "I": (1, 0, 0, 0), "O": (1, -1, 0, 0), "J": (0, 1, 0, 0), "L": (0, -1, 0, 0),
    "U": (1, 1, 0, 0), "<": (-1, 0, 0, 0), ">": (-1, -1, 0, 0), "M": (-1, 1, 0, 0),
    "t": (0, 0, 1, 0), "b": (0, 0, -1, 0),
}  # fmt: skip
"""From a key to directions along x, y, z and about z."""
_FACTORS = {
    "q": (1.1, 1.1), "z": (0.9, 0.9), "w": (1.1, 1.0), "x": (0.9, 1.0), "e": (1.0, 1.1), "c": (1.0, 0.9),
}  # fmt: skip
"""From a key to what the two speeds are multiplied by."""
_HELP = """Drive a robot with the keys around k

   u    i    o        with Shift it goes sideways instead of turning
   j    k    l        t, b   up, down
   m    ,    .        any other key   stop

q, z   all speeds up, down by a tenth
w, x   only the linear speed
e, c   only the angular speed
Ctrl-C ends it.
"""


@dataclass(slots=True)
class KeyDrive:
    """Drive command built from the keys pressed.

    Attributes:
        speed: Linear speed [m/s].
        turn: Angular speed [rad/s].
        limits: Greatest values of both.
        direction: Of the last key, along x, y, z and about z.
    """

    speed: float = 0.5
    turn: float = 1.0
    limits: tuple[float, float] = (1000.0, 1000.0)
    direction: tuple[int, int, int, int] = (0, 0, 0, 0)

    def press(self, key: str) -> bool:
        """Handle a key; True if it changed the speeds."""
        factors = _FACTORS.get(key)
        if factors is None:
            self.direction = _MOVES.get(key, (0, 0, 0, 0))
            return False
        self.speed = min(self.speed * factors[0], self.limits[0])
        self.turn = min(self.turn * factors[1], self.limits[1])
        return True

    def fill(self, twist: geometry_msgs.msg.Twist) -> None:
        """Write the requested velocities into a twist."""
        x, y, z, yaw = self.direction
        twist.linear.x, twist.linear.y, twist.linear.z = (each * self.speed for each in (x, y, z))
        twist.angular.z = yaw * self.turn


def main(arguments: Sequence[str]) -> int:
    """Drive until Ctrl-C; returns the exit code."""
    found = parse_arguments(arguments, "teleop_twist_keyboard")
    with found.start() as node, Keyboard() as keyboard, stopping() as stop:
        node.on_shutdown.append(lambda _reason: stop.set())
        limits = (
            float(node.get_param("~speed_limit", 1000.0)),
            float(node.get_param("~turn_limit", 1000.0)),
        )
        drive = KeyDrive(
            float(node.get_param("~speed", 0.5)), float(node.get_param("~turn", 1.0)), limits
        )
        publisher = _Publisher(node)
        # Seconds between two messages without a key, and until the robot stops without one; 0: none.
        rate = float(node.get_param("~repeat_rate", 0.0))
        quiet, timeout = 0.0, float(node.get_param("~key_timeout", 0.0))
        say(_HELP + _speeds(drive))
        try:
            while not stop.is_set():
                pause = 1.0 / rate if rate > 0.0 else _LOOK_S
                keys = keyboard.wait(pause)
                if keys is None or CTRL_C in keys:
                    break
                quiet = 0.0 if keys else quiet + pause
                if not keys and 0.0 < timeout <= quiet and any(drive.direction):
                    keys = ["k"]
                for key in keys:
                    if drive.press(key):
                        say(_speeds(drive))
                if keys or rate > 0.0:
                    publisher.publish(drive)
        finally:
            if not node.closed:
                publisher.publish(KeyDrive())
    return 0


class _Publisher:
    """Sends twists, stamped or not, as ``~stamped`` says."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._stamped = bool(node.get_param("~stamped", False))
        self._frame = str(node.get_param("~frame_id", ""))
        kind = "geometry_msgs/TwistStamped" if self._stamped else "geometry_msgs/Twist"
        self._kind: Any = load_message(kind)
        self._publisher = node.advertise("cmd_vel", self._kind, 1)

    def publish(self, drive: KeyDrive) -> None:
        message = self._kind()
        if self._stamped:
            message.header.stamp = Time(nsecs=self._node.clock.now())
            message.header.frame_id = self._frame
        drive.fill(message.twist if self._stamped else message)
        self._publisher.publish(message)


def _speeds(drive: KeyDrive) -> str:
    return f"speed {drive.speed:.3f} m/s, turn {drive.turn:.3f} rad/s\n"
