"""Where links are in the frames that plugins speak of, in all worlds."""

from __future__ import annotations

import numpy as np

from gazelle.description import Pose
from gazelle.engines import Placement
from gazelle.rotations import conjugate, multiply, rotate
from gazelle.simulation import LinkHandle, Transform

Frame = tuple[LinkHandle, Pose]
"""A link, and a frame's pose in it; see ``Robot.frame``."""


def placed(frame: Frame) -> Placement:
    """Where a frame is in the world."""
    link, pose = frame
    place = link.placement()
    offset, turn = np.asarray(pose.position), np.asarray(pose.quaternion)
    return Placement(
        place.position + rotate(place.quaternion, np.broadcast_to(offset, place.position.shape)),
        multiply(place.quaternion, np.broadcast_to(turn, place.quaternion.shape)),
    )


def relative(parent: Placement, child: Placement) -> Placement:
    """Where the child is, seen from the parent."""
    back = conjugate(parent.quaternion)
    return Placement(
        rotate(back, child.position - parent.position), multiply(back, child.quaternion)
    )


def transform(parent: Frame, child: Frame, parent_name: str, child_name: str) -> Transform:
    """The transform between two frames of a robot."""
    seen = relative(placed(parent), placed(child))
    return Transform(parent_name, child_name, seen.position, seen.quaternion)
