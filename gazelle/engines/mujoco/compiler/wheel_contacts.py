"""Detection of wheels' treads, and their middles."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from gazelle.description import Capsule, Cylinder, Mesh
from gazelle.kinematics.tree import TreeLink

# How far a tread may be from round, and from its axle, as a share of its radius.
_ROUND = 0.05

# Cosine of the angle from its axle at which a cylinder is no tread any more.
_COAXIAL = 0.999

# A cylinder wider than this number of radii is a roller, where the place of contact along the axle matters.
_WIDEST = 4.0

_DIRECTIONS = 16

# No joint turns further [rad].
_LIMITLESS = 100.0


def find_wheel_geoms(
    models: Iterable[Sequence[TreeLink]], geoms: Mapping[str, Sequence[str]]
) -> dict[str, str]:
    """Return geoms that may be wheel surfaces, by MuJoCo's names, with their wheels' joints.

    Args:
        models: The bodies of each.
        geoms: Names of MuJoCo's geoms by scoped collision.
    """
    return {
        geom: body.joint_name
        for bodies in models
        for body in bodies
        if _turns_freely(body)
        for collision in body.link.collisions
        if isinstance(collision.geometry, Capsule | Cylinder | Mesh)
        for geom in geoms.get(f"{body.name}::{collision.name}", ())
    }


def _turns_freely(body: TreeLink) -> bool:
    joint = body.joint
    if joint is None or joint.type not in {"continuous", "revolute"}:
        return False
    axis = joint.axes[0]
    return joint.type == "continuous" or axis.upper - axis.lower > _LIMITLESS


def middle_of(model: mujoco.MjModel, geom: int, joint: int) -> float | None:
    """Return the position of a tread's middle along its axle, from MuJoCo's centre of the geom [m].

    Returns:
        None if it is not round about the joint's axis.
    """
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, model.geom_quat[geom])
    axis = turn.reshape(3, 3).T @ model.jnt_axis[joint]
    off = turn.reshape(3, 3).T @ (model.geom_pos[geom] - model.jnt_pos[joint])
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = model.geom_dataid[geom]
        first = model.mesh_vertadr[mesh]
        return _middle(model.mesh_vert[first : first + model.mesh_vertnum[mesh]], axis, off)
    radius, half, _ = model.geom_size[geom]
    aside = np.linalg.norm(off - axis * (off @ axis))
    if abs(axis[2]) < _COAXIAL or aside > _ROUND * radius or 2.0 * half > _WIDEST * radius:
        return None
    return 0.0


def _middle(
    vertices: NDArray[np.floating], axis: NDArray[np.float64], off: NDArray[np.float64]
) -> float | None:
    """Return the middle of a mesh's vertices, by their extent in directions about the axis."""
    along = vertices @ axis
    one, two = np.zeros((2, 3))  # NumPy's products take a tenth of a second for a thousand pieces
    mujoco.mju_cross(one, axis, np.eye(3)[np.argmin(np.abs(axis))])
    mujoco.mju_normalize3(one)
    mujoco.mju_cross(two, axis, one)
    angles = np.arange(_DIRECTIONS) * (2.0 * np.pi / _DIRECTIONS)
    ways = np.outer(np.cos(angles), one) + np.outer(np.sin(angles), two)
    reach = ((vertices + off) @ ways.T).max(axis=0)
    radius = reach.max()
    if reach.min() < (1.0 - _ROUND) * radius or np.ptp(along) > _WIDEST * radius:
        return None
    return float(along.max() + along.min()) / 2.0
