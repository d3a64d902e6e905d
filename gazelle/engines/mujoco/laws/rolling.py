"""What rolls need not be held as fast as what is gripped.

Friction is stiff, so that what is held does not creep (``surfaces.hold_fast``). Two wheels on an
axle that turn as their robot's do hold it aside at two points of one rigid body, though, and by
velocities that differ in the seventh digit. Friction that stiff makes such differences into
forces as large as friction may have, and the solver searches for where it gives way. What rolls
comes to lie on other points all the time, of which none can be said to creep. So its friction
is softer: it still gives way a hundred times less than MuJoCo's usual friction.
"""

from __future__ import annotations

import math

from gazelle.engines.mujoco.laws.layouts import offsets
from gazelle.engines.native import floats, integers, long_at, part

AT = offsets()

_ELLIPTIC = 1  # mjCONE_ELLIPTIC

# What turns slower on a surface lies there, and what turns faster rolls [rad/s].
_LIES, _ROLLS = 0.01, 0.05

# How many times stiffer friction is than the normal direction where a contact rolls.
_RATIO = 10.0


@part
def hold_loosely(model: int, data: int, contact: int, row: int) -> None:
    """Let the friction of a contact give way the more, the faster it rolls.

    Args:
        model: Address of the ``mjModel``.
        data: Address of the ``mjData``.
        contact: Address of the ``mjContact``.
        row: Its first row among the constraints.
    """
    dim = integers(contact + AT.contact_dim, 1)[0]
    if dim < 3 or integers(model + AT.model_cone, 1)[0] != _ELLIPTIC:
        return
    rate = _rolling(model, data, contact)
    if rate <= _LIES:
        return
    stiff = floats(model + AT.model_impratio, 1)[0] / _RATIO
    share = min(math.log(rate / _LIES) / math.log(_ROLLS / _LIES), 1.0)
    softer = stiff**share
    softness = floats(long_at(data + AT.softness) + 8 * row, dim)
    stiffness = floats(long_at(data + AT.stiffness) + 8 * row, dim)
    for way in range(1, dim):
        softness[way] *= softer
        stiffness[way] /= softer
    floats(contact + AT.contact_mu, 1)[0] *= math.sqrt(softer)


@part
def _rolling(model: int, data: int, contact: int) -> float:
    """How fast one surface turns on another, about axes in both [rad/s]."""
    geoms = integers(contact + AT.contact_geom, 2)
    if min(geoms[0], geoms[1]) < 0:
        return 0.0
    bodies = long_at(model + AT.model_bodyid)
    first = floats(long_at(data + AT.cvel) + 48 * integers(bodies, geoms[0] + 1)[geoms[0]], 3)
    second = floats(long_at(data + AT.cvel) + 48 * integers(bodies, geoms[1] + 1)[geoms[1]], 3)
    normal = floats(contact + AT.contact_frame, 3)
    square, spin = 0.0, 0.0
    for axis in range(3):
        turn = second[axis] - first[axis]
        square += turn * turn
        spin += turn * normal[axis]
    return math.sqrt(max(square - spin * spin, 0.0))
