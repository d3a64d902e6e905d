"""Positions for joints without sensors.

What it does, and its parameters, are those of http://wiki.ros.org/joint_state_publisher.
"""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.robot.tree import MOVABLE, JointTree, TreeJoint, position_of
from gazelle_ros.time import Time

if TYPE_CHECKING:
    from gazelle_ros.node import Node


class JointStatePublisher:
    """Sends ``joint_states``: what others say of some joints, and zeros for the rest.

    The node's private parameters ``rate`` (10 Hz), ``source_list``, ``zeros``,
    ``publish_default_positions`` (true), ``publish_default_velocities`` and
    ``publish_default_efforts`` (false) are read at the start.

    Args:
        node: Node of the topics.
        joints: Of the robot.
    """

    def __init__(self, node: Node, joints: JointTree) -> None:
        self._node = node
        self._joints = joints
        self._names = [name for name, joint in joints.items() if joint.kind in MOVABLE]
        zeros = node.get_param("~zeros", {}) or {}
        default = bool(node.get_param("~publish_default_positions", True))
        self._values: dict[str, dict[str, float]] = {"position": {}, "velocity": {}, "effort": {}}
        for name in self._names:
            if default and joints[name].mimic is None:
                self._values["position"][name] = float(zeros.get(name, _zero(joints[name])))
            if node.get_param("~publish_default_velocities", False):
                self._values["velocity"][name] = 0.0
            if node.get_param("~publish_default_efforts", False):
                self._values["effort"][name] = 0.0
        self._period = 1.0 / max(1e-3, float(node.get_param("~rate", 10.0)))
        self._lock = threading.Lock()
        self._state = sensor_msgs.msg.JointState
        self._publisher = node.advertise("joint_states", self._state, queue_size=5)
        for source in node.get_param("~source_list", []):
            node.subscribe(source, self._state, self._take)
        self._send()

    def _take(self, state: sensor_msgs.msg.JointState) -> None:
        """Store positions of some joints."""
        with self._lock:
            for field, known in self._values.items():
                for name, value in zip(state.name, getattr(state, field), strict=False):
                    if name in self._joints:
                        known[name] = value

    def _send(self) -> None:
        """Send the joints, and again after a while."""
        if self._node.closed:
            return
        now = self._node.clock.now()
        message = self._state(name=list(self._names))
        message.header.stamp = Time(now // SECOND, now % SECOND)
        with self._lock:
            positions = [
                position_of(self._joints, name, self._values["position"]) for name in self._names
            ]
            if any(position is not None for position in positions):
                message.position = [position or 0.0 for position in positions]
            for field in ("velocity", "effort"):
                known = self._values[field]
                if known:
                    setattr(message, field, [known.get(name, 0.0) for name in self._names])
        self._publisher.publish(message)
        loop = self._node.loop
        loop.call_later(self._period, lambda: loop.submit(self._send))


def _zero(joint: TreeJoint) -> float:
    """Return 0, or the middle of the limits if they exclude 0."""
    if joint.lower is None or joint.upper is None or joint.lower <= 0.0 <= joint.upper:
        return 0.0
    return (joint.lower + joint.upper) / 2.0
