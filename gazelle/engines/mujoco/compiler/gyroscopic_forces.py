"""Velocities with significant Coriolis and gyroscopic forces."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import mujoco
import numpy as np

from gazelle.description import Inertial, World
from gazelle.kinematics.tree import TreeLink

_FREE = int(mujoco.mjtJoint.mjJNT_FREE)
_BALL = int(mujoco.mjtJoint.mjJNT_BALL)
_HINGE = int(mujoco.mjtJoint.mjJNT_HINGE)

# How far a wheel may be from a body of revolution about its axle: shares of its moments.
_TOLERANCE = 0.02


def tumbling(world: World, bodies: Mapping[str, Sequence[TreeLink]]) -> list[str]:
    """Return the free links that turn about changing axes, with spin that Euler's method would increase.

    Args:
        world: The description.
        bodies: Of its models, by name.
    """
    if world.profile.integrator is not None:
        return []
    carriers = {body.parent for parts in bodies.values() for body in parts}
    return [
        body.name
        for parts in bodies.values()
        for body in parts
        if body.root == "free" and body.name not in carriers and not _is_round(body)
    ]


def swings(world: World, bodies: Mapping[str, Sequence[TreeLink]]) -> bool:
    """Return whether there are joints with swing that Euler's method would amplify.

    Args:
        world: The description.
        bodies: Of its models, by name.
    """
    if world.profile.integrator is not None:
        return False
    return any(
        body.joint is not None and body.joint.type != "fixed"
        for parts in bodies.values()
        for body in parts
    )


def unbalanced_dofs(model: mujoco.MjModel) -> tuple[list[int], list[int]]:
    """Return the angular velocities of trees with joints: hinges but balanced wheels, and spins.

    A wheel may turn as fast as it likes: it is the same from all sides, and what it does to
    its parent body depends on how fast that turns. A tree of one axis has no such
    forces at all, and a free body of one link is looked after apart.
    """
    hinges: list[int] = []
    spins: list[int] = []
    trees = model.body_treeid[model.jnt_bodyid]
    alone = np.bincount(trees, minlength=model.ntree)[trees] == 1
    for joint in np.flatnonzero(~alone | (model.jnt_type == _BALL)).tolist():
        kind, dof = int(model.jnt_type[joint]), int(model.jnt_dofadr[joint])
        if kind in (_FREE, _BALL):
            first = dof + 3 if kind == _FREE else dof
            spins += range(first, first + 3)
        elif kind == _HINGE and not _is_wheel(model, joint):
            hinges.append(dof)
    return hinges, spins


def _is_wheel(model: mujoco.MjModel, joint: int) -> bool:
    """Return whether a hinge has only a body of revolution about its axis."""
    body = int(model.jnt_bodyid[joint])
    # A slip body weighs next to nothing, see ``wheel_slip``.
    load = float(model.body_subtreemass[body] - model.body_mass[body])
    if load > _TOLERANCE * model.body_mass[body] or model.body_jntnum[body] != 1:
        return False
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, model.body_iquat[body])
    axis = turn.reshape(3, 3).T @ model.jnt_axis[joint]  # along the principal axes
    moments = model.body_inertia[body]
    about = float(axis**2 @ moments)
    tilt = np.linalg.norm(moments * axis - about * axis)
    others = float(moments.sum() - about) / 2.0
    spread = np.sqrt(max(0.0, (moments**2).sum() - about**2 - 2.0 * others**2))
    arm = model.body_ipos[body] - model.jnt_pos[joint]
    off = arm - (arm @ model.jnt_axis[joint]) * model.jnt_axis[joint]
    eccentric = float(model.body_mass[body] * off @ off)
    return bool(max(tilt, spread, eccentric) <= _TOLERANCE * about)


def _is_round(body: TreeLink) -> bool:
    """Return whether all axes through a link's centre have equal inertia."""
    inertia = (body.link.inertial or Inertial()).inertia
    mixed = (inertia.ixy, inertia.ixz, inertia.iyz)
    return not any(mixed) and inertia.ixx == inertia.iyy == inertia.izz
