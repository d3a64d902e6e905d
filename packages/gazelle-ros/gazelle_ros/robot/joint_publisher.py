"""Positions for joints without sensors.

What it does, and its parameters, are those of http://wiki.ros.org/joint_state_publisher.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.parameter_values import value_of
from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.robot.own_parameters import own_parameters
from gazelle_ros.robot.tree import (
    MOVABLE,
    JointTree,
    TreeJoint,
    TreeMimic,
    check_mimics,
    position_of,
)
from gazelle_ros.time import Time

if TYPE_CHECKING:
    from gazelle_ros.node import Node

_KNOWN = (
    "delta", "dependent_joints", "num_rows", "publish_default_efforts", "publish_default_positions",
    "publish_default_velocities", "rate", "robot_description", "source_list", "use_gui",
    "use_mimic_tags", "use_smallest_joint_limits", "zeros",
)  # fmt: skip


class JointStatePublisher:
    """Sends ``joint_states``: what others say of some joints, and zeros for the rest.

    The node's private parameters ``rate`` (10 Hz), ``source_list``, ``zeros``,
    ``publish_default_positions`` (true), ``publish_default_velocities`` and
    ``publish_default_efforts`` (false), ``use_mimic_tags`` (true), ``dependent_joints``,
    ``use_smallest_joint_limits`` (true: those of a safety controller count) and ``delta`` (0, by which
    joints move to and fro in each message) are read at the start.

    Args:
        node: Node of the topics.
        joints: Of the robot.
        sources: More topics of positions.

    Raises:
        RosError: A parameter is wrong.
    """

    def __init__(self, node: Node, joints: JointTree, sources: Sequence[str] = ()) -> None:
        self._node = node
        values = own_parameters(node, _KNOWN)
        joints = _with_dependents(node, joints)
        if node.get_param("~use_smallest_joint_limits", True):
            joints = {name: _within_soft_limits(each) for name, each in joints.items()}
        self._joints = joints
        self._delta = value_of(values, "delta", 0.0)
        self._backward: set[str] = set()
        self._names = [name for name, joint in joints.items() if joint.kind in MOVABLE]
        zeros = node.get_param("~zeros", {}) or {}
        default = bool(node.get_param("~publish_default_positions", True))
        self._values: dict[str, dict[str, float]] = {"position": {}, "velocity": {}, "effort": {}}
        for name in self._names:
            if default and joints[name].mimic is None:
                self._values["position"][name] = float(zeros.get(name, rest_position(joints[name])))
            if node.get_param("~publish_default_velocities", False):
                self._values["velocity"][name] = 0.0
            if node.get_param("~publish_default_efforts", False):
                self._values["effort"][name] = 0.0
        self._period = 1.0 / max(1e-3, float(node.get_param("~rate", 10.0)))
        self._lock = threading.Lock()
        self._state = sensor_msgs.msg.JointState
        self._publisher = node.advertise("joint_states", self._state, queue_size=5)
        for source in (*node.get_param("~source_list", []), *sources):
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
            if self._delta > 0.0:
                self._move()
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

    def _move(self) -> None:
        """Move all joints by the delta, to and fro between their limits, wheels round and round."""
        known = self._values["position"]
        for name, position in known.items():
            low, high = limits_of(self._joints[name])
            known[name] = position + (-self._delta if name in self._backward else self._delta)
            if low <= known[name] <= high:
                continue
            if self._joints[name].kind == "continuous":
                known[name] = low
            else:
                known[name] = min(max(known[name], low), high)
                self._backward ^= {name}


def rest_position(joint: TreeJoint) -> float:
    """Return 0, or the middle of the limits if they exclude 0."""
    if joint.lower is None or joint.upper is None or joint.lower <= 0.0 <= joint.upper:
        return 0.0
    return (joint.lower + joint.upper) / 2.0


def limits_of(joint: TreeJoint) -> tuple[float, float]:
    """Return least and largest position [rad or m]; half a turn to each side without limits."""
    if joint.lower is None or joint.upper is None:
        return -math.pi, math.pi
    return joint.lower, joint.upper


def _within_soft_limits(joint: TreeJoint) -> TreeJoint:
    """Return a joint with the smaller ones of its limits and those of its safety controller."""
    lower, upper = joint.lower, joint.upper
    if lower is not None and joint.soft_lower is not None:
        lower = max(lower, joint.soft_lower)
    if upper is not None and joint.soft_upper is not None:
        upper = min(upper, joint.soft_upper)
    return replace(joint, lower=lower, upper=upper)


def _with_dependents(node: Node, joints: JointTree) -> JointTree:
    """Return joints that follow others as the parameters say.

    Raises:
        RosError: One follows a joint that is not there, or itself, or has no parent.
    """
    tags = bool(node.get_param("~use_mimic_tags", True))
    found = {name: each if tags else replace(each, mimic=None) for name, each in joints.items()}
    given: Any = node.get_param("~dependent_joints", {}) or {}
    for name, values in given.items():
        if name not in found or not isinstance(values, dict) or "parent" not in values:
            raise RosError(
                f"'dependent_joints' has no joint and its parent in '{name}: {values}'",
                hint="such as {finger_2: {parent: finger_1, factor: -1.0, offset: 0.0}}",
            )
        factor, offset = value_of(values, "factor", 1.0), value_of(values, "offset", 0.0)
        found[name] = replace(found[name], mimic=TreeMimic(str(values["parent"]), factor, offset))
    check_mimics(found)
    return found
