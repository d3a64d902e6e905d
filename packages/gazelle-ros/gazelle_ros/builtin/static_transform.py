"""``static_transform_publisher`` of tf and of tf2_ros."""

from __future__ import annotations

import math
from collections.abc import Sequence

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.parameter_values import positive
from gazelle_ros.builtin.arguments import parse_arguments, spin
from gazelle_ros.msgs import geometry_msgs, tf2_msgs
from gazelle_ros.node import Node
from gazelle_ros.time import Time

_USAGE = "x y z (yaw pitch roll | qx qy qz qw) frame_id child_frame_id"
Quaternion = tuple[float, float, float, float]


def main_tf2(arguments: Sequence[str]) -> int:
    """Send one transform on ``/tf_static``; returns the exit code."""
    found = parse_arguments(arguments, "static_transform_publisher", anonymous=True)
    transform = _transform(found.plain, f"static_transform_publisher {_USAGE}")
    with found.start() as node:
        kind = tf2_msgs.msg.TFMessage
        publisher = node.advertise("/tf_static", kind, queue_size=100, latch=True)
        transform.header.stamp = Time(nsecs=node.clock.now())
        publisher.publish(kind(transforms=[transform]))
        return spin(node)


def main_tf(arguments: Sequence[str]) -> int:
    """Send one transform on ``/tf`` again and again; returns the exit code."""
    found = parse_arguments(arguments, "static_transform_publisher", anonymous=True)
    usage = f"static_transform_publisher {_USAGE} period_in_ms"
    if len(found.plain) < 2:
        raise RosError("there are too few arguments", hint=usage)
    *rest, period = found.plain
    transform = _transform(rest, usage)
    seconds = positive("the period", period, usage) / 1000.0
    with found.start() as node:
        _repeat(node, transform, seconds)
        return spin(node)


def _repeat(node: Node, transform: geometry_msgs.msg.TransformStamped, seconds: float) -> None:
    """Send a transform at a period of wall time, each valid for the next period too."""
    kind = tf2_msgs.msg.TFMessage
    publisher = node.advertise("/tf", kind, queue_size=100)

    def send() -> None:
        if node.closed:
            return
        now = node.clock.now()
        if now:
            transform.header.stamp = Time(nsecs=now + round(seconds * 1e9))
            publisher.publish(kind(transforms=[transform]))
        node.loop.call_later(seconds, send)

    node.loop.call_later(0.0, send)


def _transform(words: Sequence[str], usage: str) -> geometry_msgs.msg.TransformStamped:
    """Return the message of a command line.

    Raises:
        RosError: The command line is wrong.
    """
    if len(words) not in {8, 9}:
        raise RosError(f"there are {len(words)} arguments where 8 or 9 belong", hint=usage)
    *numbers, parent, child = words
    values = [_number(each, usage) for each in numbers]
    if parent.strip("/") == child.strip("/"):
        raise RosError(f"both frames are called '{parent}'", hint=usage)
    rotation = from_angles(*values[3:]) if len(values) == 6 else (*values[3:],)
    norm = math.sqrt(sum(each * each for each in rotation))
    if not norm > 1e-9:
        raise RosError("the quaternion is zero", hint=usage)
    made = geometry_msgs.msg.TransformStamped()
    made.header.frame_id, made.child_frame_id = parent, child
    place, turn = made.transform.translation, made.transform.rotation
    place.x, place.y, place.z = values[:3]
    turn.x, turn.y, turn.z, turn.w = (each / norm for each in rotation)
    return made


def from_angles(yaw: float, pitch: float, roll: float) -> Quaternion:
    """Return the quaternion (x, y, z, w) of roll about x, pitch about y, yaw about z [rad].

    The axes are fixed.

    Formula: product of the three quaternions, as in REP 103's convention.
    """
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
    cr, sr = math.cos(roll / 2), math.sin(roll / 2)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def _number(text: str, usage: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise RosError(f"'{text}' is not a number", hint=usage) from None
