"""Friction that differs by direction.

ODE's first friction direction is the file's ``fdir1``, which turns with its collision, or,
without one, a direction chosen by the normal: world y on level ground, level on a wall. What
of this MuJoCo's contacts do not know of themselves it is set in every step (see ``contact_laws.kernel``).
"""

from __future__ import annotations

import numpy as np

from gazelle.description import Collision, Pose
from gazelle.engines.mujoco.compiler.surfaces import friction_of, second_friction_of
from gazelle.engines.mujoco.contact_laws.law_data import DirectionalFriction
from gazelle.rotations import rotate


def is_directional(collision: Collision) -> bool:
    """Return whether a surface has more friction in one direction than in the other."""
    return friction_of(collision) != second_friction_of(collision)


def friction_between(first: Collision, second: Collision) -> tuple[float, float]:
    """Return the coefficients along the first and second direction: the smaller of each."""
    along = min(friction_of(first), friction_of(second))
    return along, min(second_friction_of(first), second_friction_of(second))


def directional_friction_of(collision: Collision, placed: Pose) -> DirectionalFriction | None:
    """Return the friction directions of a surface; None without any.

    Args:
        collision: The description.
        placed: Pose in the frame of MuJoCo's body.
    """
    fdir1 = np.array(collision.surface.friction.fdir1, np.float64)
    size = np.linalg.norm(fdir1)
    if size > 0.0:
        x, y, z = rotate(np.array(placed.quaternion), fdir1 / size).tolist()
        return DirectionalFriction((x, y, z), friction_of(collision))
    return DirectionalFriction(None, friction_of(collision)) if is_directional(collision) else None
