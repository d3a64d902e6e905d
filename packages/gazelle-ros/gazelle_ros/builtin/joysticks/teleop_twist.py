"""The node ``teleop_node`` of teleop_twist_joy: a joystick's axes as a twist (http://wiki.ros.org/teleop_twist_joy)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from gazelle_ros.base.parameter_values import Values, value_of, warn_of_unknown
from gazelle_ros.builtin.arguments import CallbackWork, run_node
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.msgs import geometry_msgs, sensor_msgs
from gazelle_ros.node import Node

_LINEAR = {"x": "x", "y": "y", "z": "z"}
_ANGULAR = {"roll": "x", "pitch": "y", "yaw": "z"}
"""From names of parameters to fields of a twist."""


@dataclass(frozen=True, slots=True)
class AxisScales:
    """Axes of the joystick for a vector, and their scales, by field.

    Attributes:
        axes: Numbers of axes.
        normal: Scale without the turbo button.
        turbo: The same with the turbo button.
    """

    axes: Mapping[str, int]
    normal: Mapping[str, float]
    turbo: Mapping[str, float]

    def fill(self, vector: Any, axes: Sequence[float], *, turbo: bool) -> None:
        """Write a vector; fields without an axis or a scale stay."""
        scales = self.turbo if turbo else self.normal
        for field, number in self.axes.items():
            if field in scales and 0 <= number < len(axes):
                setattr(vector, field, axes[number] * scales[field])


def axis_scales(
    where: str, values: Values, kind: str, usual: tuple[str, int, float, float | None]
) -> AxisScales:
    """Return the axes of a vector from its parameters.

    Args:
        where: Namespace of the parameters, for messages.
        values: The parameters.
        kind: ``linear`` or ``angular``.
        usual: Usual values where there is one axis only: its name and the defaults of its number, of its scale
            and of that with turbo, None for the scale itself.

    Raises:
        Error: A parameter is of another kind.
    """
    fields = _LINEAR if kind == "linear" else _ANGULAR
    names = [f"axis_{kind}", f"scale_{kind}", f"scale_{kind}_turbo"]
    if isinstance(values.get(names[0]), Mapping):
        axes, normal, turbo = (value_of(values, name, {}) for name in names)
        for name, each in zip(names, (axes, normal, turbo), strict=True):
            warn_of_unknown(f"{where}/{name}", each, fields)
        return AxisScales(
            {fields[key]: value_of(axes, key, 0) for key in axes if key in fields},
            {fields[key]: value_of(normal, key, 0.0) for key in normal if key in fields},
            {fields[key]: value_of(turbo, key, 0.0) for key in turbo if key in fields},
        )
    key, axis, scale, fast = usual
    scale = value_of(values, names[1], scale)
    return AxisScales(
        {fields[key]: value_of(values, names[0], axis)},
        {fields[key]: scale},
        {fields[key]: value_of(values, names[2], scale if fast is None else fast)},
    )


class TeleopTwistJoy(CallbackWork):
    """Twists on ``cmd_vel`` while a button is held, and one of zeros when it is released.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        super().__init__(node)
        values, where = private_values(node), node.resolve("~")
        self._enable = value_of(values, "enable_button", 0)
        self._turbo = value_of(values, "enable_turbo_button", -1)
        self.linear = axis_scales(where, values, "linear", ("x", 1, 0.5, 1.0))
        self.angular = axis_scales(where, values, "angular", ("yaw", 0, 0.5, None))
        known = [f"{what}_{kind}" for what in ("axis", "scale") for kind in ("linear", "angular")]
        known += ["enable_button", "enable_turbo_button"]
        warn_of_unknown(where, values, [*known, "scale_linear_turbo", "scale_angular_turbo"])
        self._stopped = False
        self._commands = node.advertise("cmd_vel", geometry_msgs.msg.Twist, 1, latch=True)
        node.subscribe("joy", sensor_msgs.msg.Joy, self._take, queue_size=1)

    def _take(self, joy: sensor_msgs.msg.Joy) -> None:
        twist = self.command(joy)
        if twist is not None:
            self._commands.publish(twist)

    def command(self, joy: sensor_msgs.msg.Joy) -> geometry_msgs.msg.Twist | None:
        """Return the command of a joystick's state; None if there is none."""
        twist = geometry_msgs.msg.Twist()
        turbo = _is_pressed(joy, self._turbo)
        if turbo or _is_pressed(joy, self._enable):
            self.linear.fill(twist.linear, list(joy.axes), turbo=turbo)
            self.angular.fill(twist.angular, list(joy.axes), turbo=turbo)
            self._stopped = False
            return twist
        stopped, self._stopped = self._stopped, True
        return None if stopped else twist


def main(arguments: Sequence[str]) -> int:
    """Publish commands until shutdown; returns the exit code."""
    return run_node(arguments, "teleop_twist_joy", TeleopTwistJoy)


def _is_pressed(joy: sensor_msgs.msg.Joy, button: int) -> bool:
    return 0 <= button < len(joy.buttons) and bool(joy.buttons[button])
