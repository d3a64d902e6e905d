"""Friction that differs by direction: what of it MuJoCo's contacts can hold.

ODE's first friction direction is the file's ``fdir1``, which turns with its body, or, without
one, a direction chosen by the normal: world y on level ground. MuJoCo chooses the directions
of a contact itself: on level ground world y comes first, too. So friction without ``fdir1``,
and one fixed to what does not move and along x or y, comes out right. A direction that turns
with a body cannot be told to MuJoCo.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from gazelle.description import Collision
from gazelle.engines.mujoco.surfaces import friction_of, second_friction_of
from gazelle.errors import EngineWarning
from gazelle.rotations import rotate

Quaternion = tuple[float, float, float, float]

# A direction this near to an axis of the world is taken as that axis [rad].
_NEAR = math.radians(5.0)


@dataclass(frozen=True, slots=True)
class Rubbing:
    """What of a surface matters for friction.

    Attributes:
        collision: The description.
        turn: How it stands in the world (x, y, z, w); None if it moves.
    """

    collision: Collision
    turn: Quaternion | None


def is_directional(collision: Collision) -> bool:
    """Whether a surface resists more in one direction than in the other."""
    return friction_of(collision) != second_friction_of(collision)


def friction_between(first: Rubbing, second: Rubbing) -> tuple[float, float]:
    """Coefficients along MuJoCo's first and second direction: ODE's, the smaller of each."""
    ends = (first, second)
    along = min(friction_of(end.collision) for end in ends)
    across = min(second_friction_of(end.collision) for end in ends)
    if along == across:
        return along, along
    directed = [end for end in ends if any(end.collision.surface.friction.fdir1)]
    if not directed:
        return along, across
    owner = min(directed, key=lambda end: friction_of(end.collision))
    axis = _axis_of(owner)
    if axis is None:
        _warn(owner, along, across)
        return along, along
    return (along, across) if axis == "y" else (across, along)


def warn_of_slip(collisions: Iterable[Collision]) -> None:
    """Say that slip in proportion to the force is not simulated, if some surface has it."""
    slips = [c for c in collisions if c.surface.friction.slip1 or c.surface.friction.slip2]
    if slips:
        others = f" and {len(slips) - 1} others" if len(slips) > 1 else ""
        warnings.warn(
            EngineWarning(f"slip1 and slip2 of collision '{slips[0].name}'{others} have no effect"),
            stacklevel=2,
        )


def _axis_of(owner: Rubbing) -> str | None:
    """The horizontal axis of the world that a fixed ``fdir1`` lies along, if any."""
    if owner.turn is None:
        return None
    local = np.array(owner.collision.surface.friction.fdir1, np.float64)
    x, y, z = np.abs(rotate(np.array(owner.turn), local / np.linalg.norm(local)))
    if z < math.sin(_NEAR):
        if y > math.cos(_NEAR):
            return "y"
        if x > math.cos(_NEAR):
            return "x"
    return None


def _warn(owner: Rubbing, along: float, across: float) -> None:
    why = "turns with the link" if owner.turn is None else "is not along x or y of the world"
    warnings.warn(
        EngineWarning(
            f"collision '{owner.collision.name}': friction differs by direction ({along:g} along "
            f"fdir1, {across:g} across), and fdir1 {why}; {along:g} is used in all directions"
        ),
        stacklevel=2,
    )
