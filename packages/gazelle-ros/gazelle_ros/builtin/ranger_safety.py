"""The nodelet ``yocs_safety_controller``: a stop where a ranger sees something (http://wiki.ros.org/yocs_safety_controller)."""

from __future__ import annotations

import math
import threading
from dataclasses import dataclass

from gazelle_ros.base.parameter_values import positive
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.builtin.speeds import Speeds, repeat, twist_of
from gazelle_ros.builtin.switching import EnableSwitch
from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import geometry_msgs, sensor_msgs
from gazelle_ros.node import Node

_HERTZ = 10.0
_QUEUE = 10


@dataclass(frozen=True, slots=True)
class RangerSafetySettings:
    """Parameters of ``yocs_safety_controller``.

    Attributes:
        reverse: Whether the robot drives back after a stop.
        reversing_distance: Way back [m].
        reversing_velocity: Speed on it [m/s].
    """

    reverse: bool = False
    reversing_distance: float = 0.02
    reversing_velocity: float = 0.02


class RangerSafety:
    """Stops on ``~cmd_vel`` when a range of ``~rangers`` is -Inf, and ways back after them.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self.settings = settings_of(node, RangerSafetySettings)
        positive("reversing_velocity", self.settings.reversing_velocity)
        self.switch = EnableSwitch(node)
        self._seen, self._back_since = False, 0
        self._output = node.advertise("~cmd_vel", geometry_msgs.msg.Twist, queue_size=_QUEUE)
        node.subscribe("~rangers", sensor_msgs.msg.Range, self._take, _QUEUE)

    def run(self, stop: threading.Event) -> None:
        """Publish commands until shutdown."""
        repeat(self._node, _HERTZ, self._publish, stop)

    def step(self) -> Speeds | None:
        """Return the command of this cycle; None if there is none."""
        now, own = self._node.clock.now(), self.settings
        if self._back_since:
            if now - self._back_since <= own.reversing_distance / own.reversing_velocity * SECOND:
                return -own.reversing_velocity, 0.0
            self._back_since = 0
            return None
        if not self._seen:
            return None
        self._seen = False
        self._back_since = now if own.reverse else 0
        return 0.0, 0.0

    def _publish(self) -> None:
        found = self.step()
        if found is not None:
            self._output.publish(twist_of(found))

    def _take(self, message: sensor_msgs.msg.Range) -> None:
        if self.switch.on and message.range == -math.inf:
            self._seen = True
