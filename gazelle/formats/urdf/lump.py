"""Mass and inertia of several links as those of one body."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.description import Inertia, Inertial, Pose
from gazelle.formats.urdf.tree import Body


def body_inertial(body: Body) -> Inertial | None:
    """The inertial of a body; None when none of its links has a mass.

    A body of one link keeps its numbers to the last bit.
    """
    parts = [
        (member.pose, member.link.inertial)
        for member in body.members
        if member.link.inertial is not None and member.link.inertial.mass > 0.0
    ]
    if not parts:
        return None
    own = body.link.inertial
    if len(parts) == 1 and parts[0][1] is own:
        return own
    rotation = Pose() if own is None else Pose.from_quaternion((0, 0, 0), own.pose.quaternion)
    return combine(parts, rotation)


def combine(parts: Sequence[tuple[Pose, Inertial]], rotation: Pose) -> Inertial:
    """The sum of inertials, each at a pose, in axes turned by ``rotation``.

    Steiner's theorem: about a point at distance d from the centre of mass, the inertia is
    I + m (d.d E - d d^T).
    """
    masses = np.array([inertial.mass for _, inertial in parts])
    placed = [pose * inertial.pose for pose, inertial in parts]
    centers = np.array([pose.position for pose in placed])
    mass = float(masses.sum())
    center = masses @ centers / mass
    total = np.zeros((3, 3))
    for (_, inertial), pose, own in zip(parts, placed, centers, strict=True):
        turn = pose.matrix()[:3, :3]
        d = own - center
        total += turn @ tensor(inertial.inertia) @ turn.T
        total += inertial.mass * (d @ d * np.eye(3) - np.outer(d, d))
    axes = rotation.matrix()[:3, :3]
    i = axes.T @ total @ axes
    return Inertial(
        mass=mass,
        pose=Pose.from_quaternion([float(c) for c in center], rotation.quaternion),
        inertia=Inertia(*(float(i[k]) for k in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)))),
        source=parts[0][1].source,
    )


def tensor(i: Inertia) -> NDArray[np.float64]:
    """The inertia as a matrix, shape (3, 3) [kg m²]."""
    return np.array([[i.ixx, i.ixy, i.ixz], [i.ixy, i.iyy, i.iyz], [i.ixz, i.iyz, i.izz]])
