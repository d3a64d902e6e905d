"""Poses of the frames that plugins name, in all worlds."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from gazelle.description import Joint, Pose
from gazelle.engines import Placement
from gazelle.rotations import multiply, rotate
from gazelle.simulation import FramePrefix, LinkHandle, Output, Robot, Transform, Transforms

# Of tf2_ros::TransformBroadcaster.
_QUEUE = 100

Frame = tuple[LinkHandle, Pose]
"""A link, and a frame's pose in it; see ``Robot.frame``."""


def placed(frame: Frame) -> Placement:
    """Return the placement of a frame in the world."""
    link, pose = frame
    place = link.placement()
    offset, turn = np.asarray(pose.position), np.asarray(pose.quaternion)
    return Placement(
        place.position + rotate(place.quaternion, np.broadcast_to(offset, place.position.shape)),
        multiply(place.quaternion, np.broadcast_to(turn, place.quaternion.shape)),
    )


def transform(parent: Frame, child: Frame, parent_name: str, child_name: str) -> Transform:
    """Return the transform between two frames of a robot."""
    seen = placed(child).relative_to(placed(parent))
    return Transform(parent_name, child_name, seen.position, seen.quaternion)


def frames_output(
    produce: Callable[[], Transforms],
    namespace: str | None = None,
    prefix: FramePrefix = FramePrefix.NEAREST,
) -> Output[Transforms]:
    """Return an output on ``/tf``, with the queue size of tf's own broadcasters."""
    return Output("/tf", Transforms, produce, queue_size=_QUEUE, namespace=namespace, prefix=prefix)


def joint_transforms(robot: Robot, joints: Iterable[Joint]) -> Transforms:
    """Return the pose of each joint's child link in the joint's parent now."""
    return Transforms(
        robot.simulation.clock.now_ns,
        tuple(
            transform(
                robot.frame(joint.parent), robot.frame(joint.child), joint.parent, joint.child
            )
            for joint in joints
        ),
    )
