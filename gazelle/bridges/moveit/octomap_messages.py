"""The octomap of a planning scene from and to ``octomap_msgs/OctomapWithPose``."""

from __future__ import annotations

import numpy as np

from gazelle.bridges.conversions import pose_message, pose_of_message
from gazelle.description import Pose
from gazelle.formats import Octree
from gazelle.planning import OCTOMAP, PlanningScene, SceneObject, octree_object
from gazelle_ros.msgs import octomap_msgs


def octomap_of_message(
    message: octomap_msgs.msg.OctomapWithPose, frame: Pose
) -> SceneObject | None:
    """Convert an octomap; None if it has no data, which clears the present one.

    Args:
        message: The ``OctomapWithPose``.
        frame: Its header's frame, in the one that is planned in.

    Raises:
        FormatError: It cannot be read.
        PlanningError: It has too many boxes.
    """
    sent = message.octomap
    if not sent.data:
        return None
    data = np.asarray(sent.data, np.int8).tobytes()
    octree = Octree(float(sent.resolution), data, bool(sent.binary), sent.id)
    return octree_object(octree, frame * pose_of_message(message.origin))


def octomap_message(scene: PlanningScene) -> octomap_msgs.msg.OctomapWithPose:
    """Return the ``OctomapWithPose`` of a scene, in the planning frame; empty without one."""
    message = octomap_msgs.msg.OctomapWithPose()
    message.header.frame_id = scene.robot.frame
    known = scene.objects.get(OCTOMAP)
    if known is not None and known.octree is not None:
        octree = known.octree
        message.origin = pose_message(known.pose)
        message.octomap.header.frame_id = scene.robot.frame
        message.octomap.id, message.octomap.binary = octree.kind, octree.binary
        message.octomap.resolution = octree.resolution
        message.octomap.data = np.frombuffer(octree.data, np.int8).tolist()
    return message
