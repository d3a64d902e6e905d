"""Positions of joints in, transforms between links out.

What it does, and its parameters, are those of http://wiki.ros.org/robot_state_publisher.
"""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING

from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import geometry_msgs, sensor_msgs, tf2_msgs
from gazelle_ros.robot.own_parameters import own_parameters
from gazelle_ros.robot.tree import MOVABLE, JointTree, TreeJoint, position_of
from gazelle_ros.tf.naming import FramePrefixes, resolve_frame
from gazelle_ros.time import Time

if TYPE_CHECKING:
    from gazelle_ros.node import Node

_LOG = logging.getLogger("gazelle.ros.robot")
_KNOWN = (
    "publish_frequency", "use_tf_static", "ignore_timestamp", "frame_prefix", "tf_prefix",
    "robot_description",
)  # fmt: skip
_AHEAD_NS = SECOND // 2
"""Time by which stamps of fixed joints are ahead when they are sent repeatedly."""


class RobotStatePublisher:
    """Sends the transforms of a robot: of fixed joints once, of others as they move.

    The node's private parameters ``publish_frequency`` (50 Hz), ``use_tf_static`` (true),
    ``ignore_timestamp`` (false) and ``frame_prefix`` are read at the start, and the nearest
    parameter ``tf_prefix``.

    Args:
        node: Node of the topics: ``joint_states``, ``/tf``, ``/tf_static``.
        joints: Of the robot.
    """

    def __init__(self, node: Node, joints: JointTree) -> None:
        self._node = node
        self._joints = joints
        own_parameters(node, _KNOWN)
        self._prefix = str(node.get_param("~frame_prefix", "") or "")
        self._tf_prefix = FramePrefixes(node).of(node.name)
        self._period = 1.0 / max(1e-3, float(node.get_param("~publish_frequency", 50.0)))
        self._always = bool(node.get_param("~ignore_timestamp", False))
        self._sent: dict[str, int] = {}
        self._last = 0
        self._transform = geometry_msgs.msg.TransformStamped
        self._many = tf2_msgs.msg.TFMessage
        self._moving = node.advertise("/tf", self._many, queue_size=100)
        self._static = node.advertise("/tf_static", self._many, queue_size=100, latch=True)
        self._fixed = [joint for joint in joints.values() if joint.kind not in MOVABLE]
        if node.get_param("~use_tf_static", True):
            self._static.publish(self._many(self._fixed_transforms(node.clock.now())))
        elif self._fixed:
            self._send_fixed()
        states = sensor_msgs.msg.JointState
        self._subscriber = node.subscribe("joint_states", states, self.take, queue_size=1)

    def take(self, state: sensor_msgs.msg.JointState) -> None:
        """Publish the transforms of the joints of a ``JointState``."""
        if len(state.name) != len(state.position):
            if state.position:
                _LOG.error("a JointState has %d names and %d positions", len(state.name),
                           len(state.position))  # fmt: skip
            return
        now = self._node.clock.now()
        if now < self._last:  # simulated time jumped back
            self._sent.clear()
        self._last = now
        stamp = state.header.stamp.to_nsec() or now
        positions = dict(zip(state.name, state.position, strict=True))
        given = [name for name in self._joints if self._concerns(name, positions)]
        oldest = min((self._sent.get(name, 0) for name in given), default=0)
        if not given or (not self._always and stamp < oldest + int(self._period * SECOND)):
            return
        transforms = [
            self._message(self._joints[name], position, stamp)
            for name in given
            if (position := position_of(self._joints, name, positions)) is not None
        ]
        self._sent |= dict.fromkeys(given, stamp)
        self._moving.publish(self._many(transforms))

    def _concerns(self, name: str, positions: dict[str, float]) -> bool:
        """Return whether a message gives a joint's position."""
        if self._joints[name].kind not in MOVABLE:
            return False
        return position_of(self._joints, name, positions) is not None

    def _fixed_transforms(self, stamp: int) -> list[geometry_msgs.msg.TransformStamped]:
        return [self._message(joint, 0.0, stamp) for joint in self._fixed]

    def _send_fixed(self) -> None:
        """Send the fixed joints on /tf, and again after a while."""
        if self._node.closed:
            return
        stamp = self._node.clock.now() + _AHEAD_NS
        self._moving.publish(self._many(self._fixed_transforms(stamp)))
        loop = self._node.loop
        loop.call_later(self._period, lambda: loop.submit(self._send_fixed))

    def _message(
        self, joint: TreeJoint, position: float, stamp: int
    ) -> geometry_msgs.msg.TransformStamped:
        translation, rotation = joint.placed(position)
        made = self._transform()
        made.header.stamp = Time(stamp // SECOND, stamp % SECOND)
        made.header.frame_id = self._frame(joint.parent)
        made.child_frame_id = self._frame(joint.child)
        place, turn = made.transform.translation, made.transform.rotation
        place.x, place.y, place.z = translation
        turn.x, turn.y, turn.z, turn.w = rotation
        return made

    def _frame(self, link: str) -> str:
        return resolve_frame(self._tf_prefix, self._prefix + link)
