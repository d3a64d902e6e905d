"""Mass and inertia of several links as those of one body."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.description import Inertia, Inertial, Pose
from gazelle.formats.solids import Solid, joined
from gazelle.formats.urdf.tree import Body


def body_inertial(body: Body) -> Inertial | None:
    """The inertial of a body; None when none of its links has a mass.

    A body of one link keeps its numbers to the last bit. A lumped link without mass gives its
    inertia all the same, as in libsdformat.
    """
    parts = [
        (member.pose, member.link.inertial)
        for member in body.members
        if member.link.inertial is not None
        and (member.link.inertial.mass > 0.0 or member.link.inertial.inertia.matrix().any())
    ]
    if not any(inertial.mass > 0.0 for _, inertial in parts):
        return None
    own = body.link.inertial
    if len(parts) == 1 and parts[0][1] is own:
        return own
    rotation = Pose() if own is None else Pose.from_quaternion((0, 0, 0), own.pose.quaternion)
    return combine(parts, rotation)


def combine(parts: Sequence[tuple[Pose, Inertial]], rotation: Pose) -> Inertial | None:
    """The sum of inertials at poses, in axes turned by ``rotation``; None without mass."""
    whole = joined(
        Solid(inertial.mass, np.zeros(3), inertial.inertia.matrix()).placed(pose * inertial.pose)
        for pose, inertial in parts
    )
    if whole is None:
        return None
    axes = rotation.matrix()[:3, :3]
    return Inertial(
        mass=whole.volume,
        pose=Pose.from_quaternion(whole.center.tolist(), rotation.quaternion),
        inertia=Inertia.from_matrix(axes.T @ whole.inertia @ axes),
        source=parts[0][1].source,
    )
