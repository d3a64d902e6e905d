"""Commands of speed for a base that drives on the ground, at a rate."""

from __future__ import annotations

import threading
from collections.abc import Callable

from gazelle_ros.clock import Rate
from gazelle_ros.msgs import geometry_msgs
from gazelle_ros.node import Node

Speeds = tuple[float, float]
"""Along x [m/s] and about z [rad/s]."""


def twist_of(speeds: Speeds) -> geometry_msgs.msg.Twist:
    """Return speeds as a message."""
    made = geometry_msgs.msg.Twist()
    made.linear.x, made.angular.z = speeds
    return made


def repeat(node: Node, hertz: float, work: Callable[[], object], stop: threading.Event) -> None:
    """Do work at a rate of the node's clock until shutdown.

    Args:
        node: On the graph.
        hertz: Rate.
        work: Done once a cycle.
        stop: Set for the end.
    """

    def ended() -> bool:
        return stop.is_set() or node.closed

    rate = Rate(node.clock, hertz, reset=True)
    while not ended():
        work()
        rate.sleep(ended)
