"""Poses of messages in the frame that is planned in."""

from __future__ import annotations

from functools import partial

from gazelle.array_types import Floats
from gazelle.bridges.conversions import pose_message, pose_of_message, pose_of_transform
from gazelle.description import Pose
from gazelle.errors import PlanningError
from gazelle.planning import NoPlanError, PlanningScene, PlanOutcome
from gazelle_ros.msgs import geometry_msgs, tf2_msgs
from gazelle_ros.node import Node
from gazelle_ros.tf import FrameTree, TransformException, take_transforms
from gazelle_ros.time import Time


class PlanningFrames:
    """Frames of a robot, of objects in its scene, and of ``/tf``.

    Args:
        node: Listens to ``/tf`` and ``/tf_static``.
        scene: With the robot.
    """

    def __init__(self, node: Node, scene: PlanningScene) -> None:
        self._scene, self._tree = scene, FrameTree()
        robot = scene.robot
        held = robot.semantics.virtual_joints
        still = {each.parent_frame for each in held if each.type == "fixed"}
        self._same = {"", robot.frame} | {name.lstrip("/") for name in still}
        kind = tf2_msgs.msg.TFMessage
        for topic, static in (("/tf", False), ("/tf_static", True)):
            take = partial(take_transforms, self._tree, authority="move_group", static=static)
            node.subscribe(topic, kind, take)

    def find(self, frame: str, state: Floats) -> Pose:
        """Return the pose of a frame in the planning frame.

        Args:
            frame: Of the message's header.
            state: State of the robot, shape (variables,).

        Raises:
            NoPlanError: It is not known.
        """
        name = frame.lstrip("/")
        if name in self._same:
            return Pose()
        try:
            return self._scene.pose_of(name, state)
        except PlanningError:
            pass
        try:
            found = self._tree.lookup(self._scene.robot.frame, name, 0)
        except TransformException as error:
            raise NoPlanError(
                f"the frame '{frame}' is not known: {error}", PlanOutcome.FRAME_TRANSFORM_FAILURE
            ) from None
        return pose_of_transform(found)

    def pose(self, stamped: geometry_msgs.msg.PoseStamped, state: Floats) -> Pose:
        """Return a ``geometry_msgs/PoseStamped`` in the planning frame; see ``find``."""
        return self.find(stamped.header.frame_id, state) * pose_of_message(stamped.pose)


def stamped_message(pose: Pose, frame: str, now: int) -> geometry_msgs.msg.PoseStamped:
    """Return a ``geometry_msgs/PoseStamped`` at a time [ns]."""
    message = geometry_msgs.msg.PoseStamped()
    message.header.frame_id, message.header.stamp = frame, Time(nsecs=now)
    message.pose = pose_message(pose)
    return message
