"""Mass and inertia of several links as those of one body."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from gazelle.description import Inertia, Inertial, Pose
from gazelle.formats.urdf.tree import LumpedLink
from gazelle.formats.urdf.upright import upright
from gazelle.geometry.solids import UnitSolid, joined

NO_MASS = 1e-6
"""A mass up to this [kg] is none, as it is to libsdformat."""


def body_inertial(body: LumpedLink) -> Inertial | None:
    """Return the inertial of a body; None when its links have no mass.

    A body of one link keeps its numbers to the last bit. A link without mass may still add an
    inertia, as it does in libsdformat.
    """
    parts = [
        (member.upright, member.link.inertial)
        for member in body.members
        if member.link.inertial is not None
        and (member.link.inertial.mass > 0.0 or member.link.inertial.inertia.matrix().any())
    ]
    if sum(inertial.mass for _, inertial in parts) <= NO_MASS:
        return None
    own = body.link.inertial
    if len(parts) == 1 and parts[0][1] is own:
        return own
    parts = [(place, replace(part, pose=upright(part.pose))) for place, part in parts]
    rotation = Pose() if own is None else Pose.from_quaternion((0, 0, 0), own.pose.quaternion)
    return combine(parts, rotation)


def combine(parts: Sequence[tuple[Pose, Inertial]], rotation: Pose) -> Inertial | None:
    """Return the sum of inertials at poses, in axes turned by ``rotation``; None without mass."""
    whole = joined(
        UnitSolid(inertial.mass, np.zeros(3), inertial.inertia.matrix()).placed(
            (pose * inertial.pose).matrix()
        )
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
