"""Nodes of twist_mux: the velocity command of highest priority, and its marker (http://wiki.ros.org/twist_mux)."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin.arguments import parse_arguments, run_node, spin
from gazelle_ros.builtin.diagnostics import DiagnosticPublisher
from gazelle_ros.builtin.mux_inputs import MuxInput, mux_input
from gazelle_ros.builtin.parameters import warn_of_others
from gazelle_ros.msgs import geometry_msgs, std_msgs, visualization_msgs
from gazelle_ros.node import Node

HIGHEST = 255
"""Highest priority."""
_DIAGNOSTICS_S = 1.0
_LOG = logging.getLogger("gazelle.ros.twist_mux")


@dataclass(slots=True)
class Priorities:
    """Choice among velocity sources, by their priorities and locks.

    Attributes:
        velocities: Topics of velocity commands.
        locks: Topics of locks. One that holds masks velocities of a lower priority.
    """

    velocities: Sequence[MuxInput]
    locks: Sequence[MuxInput]

    def of_locks(self, now: int) -> int:
        """Return the highest priority of the locks that hold, or 0."""
        return max((each.priority for each in self.locks if each.is_locked(now)), default=0)

    def chosen(self, now: int) -> MuxInput | None:
        """Return the source of the passed commands, or None.

        The first of those with the highest priority passes. One of priority 0 never does.
        """
        locked = self.of_locks(now)
        free = [each for each in self.velocities if not each.is_masked(now, locked)]
        best = max(free, key=lambda each: each.priority, default=None)
        return best if best is not None and best.priority > 0 else None


class TwistMux:
    """Publisher of the velocity command of highest priority on ``cmd_vel_out``.

    Args:
        node: On the graph, with the parameters ``~topics`` and ``~locks``.

    Raises:
        RosError: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._lock = threading.Lock()
        warn_of_others(node, ("topics", "locks"))
        self.priorities = Priorities(list(_sources(node, "topics")), list(_sources(node, "locks")))
        if not self.priorities.velocities:
            _LOG.warning("%s/topics is empty: no command is forwarded", node.name)
        twist, flag = geometry_msgs.msg.Twist, std_msgs.msg.Bool
        self._commands = node.advertise("cmd_vel_out", twist, queue_size=1)
        self._diagnostics = DiagnosticPublisher(node, "Twist mux status")
        for source in self.priorities.locks:
            node.subscribe(source.topic, flag, self._lock_taker(source), queue_size=1)
        for source in self.priorities.velocities:
            node.subscribe(source.topic, twist, self._command_taker(source), queue_size=1)

    def run(self, stop: threading.Event) -> None:
        """Publish diagnostics until shutdown."""
        while not self._node.closed and not stop.wait(_DIAGNOSTICS_S):
            self._diagnostics.publish(self._report())

    def _command_taker(self, source: MuxInput) -> Callable[[geometry_msgs.msg.Twist], None]:
        def take(message: geometry_msgs.msg.Twist) -> None:
            with self._lock:
                source.stamp = now = self._node.clock.now()
                if self.priorities.chosen(now) is source:
                    self._commands.publish(message)

        return take

    def _lock_taker(self, source: MuxInput) -> Callable[[std_msgs.msg.Bool], None]:
        def take(message: std_msgs.msg.Bool) -> None:
            with self._lock:
                source.stamp, source.locked = self._node.clock.now(), bool(message.data)

        return take

    def _report(self) -> dict[str, str]:
        now = self._node.clock.now()
        with self._lock:
            priority = self.priorities.of_locks(now)
            pairs = [
                (
                    f"velocity {each.name}",
                    each.described("masked" if each.is_masked(now, priority) else "unmasked"),
                )
                for each in self.priorities.velocities
            ]
            pairs += [
                (f"lock {each.name}", each.described("locked" if each.is_locked(now) else "free"))
                for each in self.priorities.locks
            ]
            pairs.append(("current priority", str(priority)))
        return dict(pairs)


def main(arguments: Sequence[str]) -> int:
    """Pass on the command of highest priority until shutdown; returns the exit code."""
    return run_node(arguments, "twist_mux", TwistMux)


def marker(arguments: Sequence[str]) -> int:
    """Publish each ``twist`` as an arrow on ``marker`` until shutdown; returns the exit code."""
    found = parse_arguments(arguments, "twist_marker")
    with found.start() as node:
        arrows = node.advertise("marker", visualization_msgs.msg.Marker, queue_size=1, latch=True)
        node.subscribe(
            "twist",
            geometry_msgs.msg.Twist,
            lambda twist: arrows.publish(arrow_of(twist)),
            queue_size=1,
        )
        return spin(node)


def arrow_of(twist: geometry_msgs.msg.Twist) -> visualization_msgs.msg.Marker:
    """Return a green arrow 2 m above ``base_footprint``, as long as the command is fast.

    It points sideways by the greater of the lateral speed [m/s] and the turn rate [rad/s].
    """
    made = visualization_msgs.msg.Marker(type=visualization_msgs.msg.Marker.ARROW)
    made.header.frame_id = "base_footprint"
    made.pose.position.z = 2.0
    made.pose.orientation.w = 1.0
    made.scale.x, made.scale.y = 0.05, 0.1  # diameters of shaft and head [m]
    made.color.g = made.color.a = 1.0
    sideways = max(twist.linear.y, twist.angular.z, key=abs)
    point = geometry_msgs.msg.Point
    made.points = [point(), point(x=twist.linear.x, y=sideways)]
    return made


def _sources(node: Node, parameter: str) -> Iterator[MuxInput]:
    """Yield the sources of a parameter.

    Raises:
        RosError: It is not a list of them.
    """
    full = node.resolve(f"~{parameter}")
    listed = node.get_param(full, [])
    if not isinstance(listed, list):
        raise RosError(
            f"{full} must be a list of name, topic, timeout and priority, not {listed!r:.60}"
        )
    for number, each in enumerate(listed):
        yield mux_input(f"{full}[{number}]", each, highest=HIGHEST)
