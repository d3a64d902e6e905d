"""Shapes that a file misaligns by rounding are snapped.

"1.57" for a quarter of a turn leaves a box on two of its corners, a dozen micrometres below the
others: a caster then brakes on one side, and the robot veers when it speeds up. ODE has a surface
layer, within which all corners bear; rigid contacts have none. So a shape that is misaligned in the
frame of its parent, by less at its ends than a tenth of ODE's layer, is put straight. Links
and joints stay where the file has them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from gazelle.description import Box, Capsule, Collision, Cylinder, Geometry, Pose
from gazelle.kinematics.tree import TreeLink

# A tenth of ODE's surface layer [m].
_LAYER = 1e-4


def straight_pose(collision: Collision, body: TreeLink, bodies: Mapping[str, TreeLink]) -> Pose:
    """Return the pose of a collision in its link, snapped if it is off-axis by rounding error.

    Args:
        collision: Of the link.
        body: The link.
        bodies: All of its model, by name, at least.
    """
    reach = _reach(collision.geometry)
    if reach is None or body.root == "static":
        return collision.pose
    carrier = _in_carrier(body, bodies)
    turn = (carrier * collision.pose).matrix()[:3, :3]
    straight = np.rint(turn)
    if not np.array_equal(straight @ straight.T, np.eye(3)) or np.linalg.det(straight) < 0.0:
        return collision.pose
    off = math.sqrt(max(0.0, float(np.square(turn - straight).sum()) / 2.0))  # the angle
    if off * reach > _LAYER or off < 1e-9:
        return collision.pose
    put = Pose.from_matrix(carrier.matrix()[:3, :3].T @ straight)
    return Pose.from_quaternion(collision.pose.position, put.quaternion)


def _in_carrier(body: TreeLink, bodies: Mapping[str, TreeLink]) -> Pose:
    """Return the pose of a link in the first link above it that a joint moves, or in the root."""
    pose = Pose()
    while body.joint is not None and body.joint.type == "fixed" and body.parent is not None:
        pose = body.pose * pose
        body = bodies[body.parent]
    return pose


def _reach(shape: Geometry) -> float | None:
    """Return the distance of a shape's farthest point from its centre [m]; None if it is not known."""
    if isinstance(shape, Box):
        return math.hypot(*shape.size) / 2.0
    if isinstance(shape, Cylinder | Capsule):
        return math.hypot(shape.radius, shape.length / 2.0)
    return None
