"""The node ``joystick_relay.py`` of twist_mux: a joystick's twists in steps of speed, with priority or without."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from typing import Any

from gazelle_ros.actions import SimpleActionServer
from gazelle_ros.base.parameter_values import Values, fields_of, positive, value_of, warn_of_unknown
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.msgs import geometry_msgs, std_msgs, twist_mux_msgs, visualization_msgs
from gazelle_ros.node import Node

_MARKER_S = 1.0


@dataclass(frozen=True, slots=True)
class TurboSettings:
    """Parameters below ``~turbo``, with the defaults: speeds at the first step and at the last.

    A speed backwards of 0, and a first step of 0, are set by others: the speed forwards, the middle.
    """

    steps: int = 1
    init_step: int = 0
    linear_forward_min: float = 1.0
    linear_forward_max: float = 1.0
    linear_backward_min: float = 0.0
    linear_backward_max: float = 0.0
    linear_lateral_min: float = 1.0
    linear_lateral_max: float = 1.0
    angular_min: float = 1.0
    angular_max: float = 1.0

    def speed(self, kind: str, step: int) -> float:
        """Return the greatest speed of a kind at a step [m/s or rad/s]."""
        first, last = getattr(self, f"{kind}_min"), getattr(self, f"{kind}_max")
        if kind == "linear_backward":
            first, last = first or self.linear_forward_min, last or self.linear_forward_max
        part = (step - 1) / (self.steps - 1) if self.steps > 1 else 0.0
        return float(first + part * (last - first))

    @property
    def first_step(self) -> int:
        """Step at the beginning."""
        inside = 1 <= self.init_step <= self.steps
        return self.init_step if inside else (self.steps + 1) // 2


class TurboControl:
    """Steps of the linear and of the angular speed.

    Args:
        settings: Their speeds.
    """

    def __init__(self, settings: TurboSettings) -> None:
        self._settings = settings
        self.linear = self.angular = settings.first_step

    def change(self, linear: int, angular: int) -> None:
        """Change both by a given number of steps, as far as there are some."""
        most = self._settings.steps
        self.linear = min(max(self.linear + linear, 1), most)
        self.angular = min(max(self.angular + angular, 1), most)

    def reset(self) -> None:
        """Set both to the first step."""
        self.linear = self.angular = self._settings.first_step

    def scaled(self, twist: geometry_msgs.msg.Twist) -> geometry_msgs.msg.Twist:
        """Return a twist with parts of -1 to 1 as speeds; zeros if it has others."""
        made = geometry_msgs.msg.Twist()
        x, y, yaw = twist.linear.x, twist.linear.y, twist.angular.z
        if max(abs(x), abs(y), abs(yaw)) > 1.0:
            return made
        if twist.linear.z or twist.angular.x or twist.angular.y:
            return made
        ahead = "linear_forward" if x >= 0.0 else "linear_backward"
        made.linear.x = x * self._settings.speed(ahead, self.linear)
        made.linear.y = y * self._settings.speed("linear_lateral", self.linear)
        made.angular.z = yaw * self._settings.speed("angular", self.angular)
        return made


class JoystickRelay:
    """Twists of ``joy_vel_in`` on ``joy_vel_out``, while ``joy_priority`` is true.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        values = private_values(node)
        warn_of_unknown(node.resolve("~"), values, ("priority",))
        self.turbo = TurboControl(_turbo_of(node, value_of(values, "turbo", {})))
        self.priority = value_of(values, "priority", True)
        self._lock = threading.Lock()
        marker, flag = visualization_msgs.msg.Marker, std_msgs.msg.Bool
        twist = geometry_msgs.msg.Twist
        self._markers = node.advertise("text_marker", marker, queue_size=1, latch=True)
        self._commands = node.advertise("joy_vel_out", twist, queue_size=1)
        self._flags = node.advertise("joy_priority", flag, queue_size=1, latch=True)
        self._publish_state()
        node.subscribe("joy_vel_in", twist, self._take, queue_size=1)
        actions = twist_mux_msgs.msg
        turbo = actions.JoyTurboAction
        self._servers = [
            self._serve("joy_priority_action", actions.JoyPriorityAction, self.toggle),
            self._serve("joy_turbo_increase", turbo, lambda: self.turbo.change(1, 1)),
            self._serve("joy_turbo_decrease", turbo, lambda: self.turbo.change(-1, -1)),
            self._serve("joy_turbo_angular_increase", turbo, lambda: self.turbo.change(0, 1)),
            self._serve("joy_turbo_angular_decrease", turbo, lambda: self.turbo.change(0, -1)),
            self._serve("joy_turbo_reset", turbo, self.turbo.reset),
        ]

    def run(self, stop: threading.Event) -> None:
        """Publish the marker until shutdown."""
        while not self._node.closed and not stop.wait(_MARKER_S):
            self._markers.publish(self._marker())
        for each in self._servers:
            each.stop()

    def toggle(self) -> None:
        """Switch the priority of the joystick on, with a command of zeros, or off."""
        with self._lock:
            self.priority = not self.priority
            self._publish_state()
            if self.priority:
                self._commands.publish(geometry_msgs.msg.Twist())

    def _take(self, twist: geometry_msgs.msg.Twist) -> None:
        with self._lock:
            if self.priority:
                self._commands.publish(self.turbo.scaled(twist))

    def _publish_state(self) -> None:
        self._flags.publish(std_msgs.msg.Bool(data=self.priority))
        self._markers.publish(self._marker())

    def _marker(self) -> visualization_msgs.msg.Marker:
        made = visualization_msgs.msg.Marker(type=visualization_msgs.msg.Marker.TEXT_VIEW_FACING)
        made.header.frame_id = "base_footprint"
        made.pose.position.z, made.pose.orientation.w, made.scale.z = 2.0, 1.0, 0.5
        made.color.a = made.color.r = made.color.g = made.color.b = 1.0
        made.text = "Manual" if self.priority else "Autonomous"
        return made

    def _serve(self, name: str, spec: Any, act: Callable[[], object]) -> SimpleActionServer:
        def execute(_goal: Any) -> None:
            act()
            server.set_succeeded()

        server = SimpleActionServer(self._node, name, spec, execute, auto_start=False)
        server.start()
        return server


def main(arguments: Sequence[str]) -> int:
    """Pass on a joystick's twists until shutdown; returns the exit code."""
    return run_node(arguments, "joystick_relay", JoystickRelay)


def _turbo_of(node: Node, values: Values) -> TurboSettings:
    where = node.resolve("~turbo")
    warn_of_unknown(where, values, [each.name for each in fields(TurboSettings)])
    settings = TurboSettings(**fields_of(TurboSettings, values))
    for each in fields(TurboSettings):
        if each.name in values and each.name != "init_step":
            positive(f"{where}/{each.name}", values[each.name])
    return settings
