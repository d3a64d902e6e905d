"""A wheel stands on the middle of its tread, whatever edge it touches with.

Rigid wheels touch a floor with their edges: by rounding (an axle turned by 1.57 instead of a
quarter) with one of them, by softness with both. Which it is decides where the ground bears and
pulls, so a robot of two such wheels veers when it speeds up, and one whose wheels stand on both
edges has to drag them when it turns. A tread gives way by more than such differences, and
kinematics take its middle. So the contact is moved there, all the way for an axle that is level,
and not at all for one that leans by as much as the tread gives way at the edge; a roller that
stands alone does not fall over.

A contact at another point has its Jacobian's rows there: for each velocity that turns a body of
the contact about an axis w they change by w x shift.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from gazelle.engines.mujoco.laws.layouts import offsets
from gazelle.engines.mujoco.laws.numbers import GEOM_NUMBERS, MIDDLE, TREAD
from gazelle.engines.native import floats, integers, long_at, part

Floats: TypeAlias = NDArray[np.float64]

AT = offsets()

_ELLIPTIC = 1  # mjCONE_ELLIPTIC

# Sine of the angle from level at which an axle is no wheel's any more.
_STEEP = 0.34

_NEAR = 1e-9  # [m]

# By how much a tread gives way at an edge: ODE's usual surface layer [m].
_GIVES = 1e-3


@part
def stand_in_the_middle(model: int, data: int, contact: int, row: int, sparse: float) -> None:
    """Move a contact with a wheel to the middle of its tread.

    Args:
        model: Address of the ``mjModel``.
        data: Address of the ``mjData``.
        contact: Address of the ``mjContact``.
        row: Its first row among the constraints.
        sparse: Whether Jacobians are.
    """
    if integers(contact + AT.contact_dim, 1)[0] < 3:
        return
    geoms = integers(contact + AT.contact_geom, 2)
    place = floats(contact + AT.contact_pos, 3)
    normal = floats(contact + AT.contact_frame, 3)
    shift = np.zeros(3)
    for side in range(2):
        geom = geoms[side]
        if geom < 0:
            continue
        own = floats(long_at(model + AT.model_geom_user) + 8 * GEOM_NUMBERS * geom, GEOM_NUMBERS)
        joint = int(own[TREAD]) - 1
        if joint < 0:
            continue
        axle = floats(long_at(data + AT.xaxis) + 24 * joint, 3)
        centre = floats(long_at(data + AT.geom_xpos) + 24 * geom, 3)
        along, lean = -own[MIDDLE], 0.0
        for axis in range(3):
            along += (place[axis] - centre[axis]) * axle[axis]
            lean += normal[axis] * axle[axis]
        share = 1.0 - abs(lean * along) / _GIVES
        if share > 0.0 and abs(lean) < _STEEP and abs(along) > _NEAR:
            for axis in range(3):
                shift[axis] = -share * along * axle[axis]
                place[axis] += shift[axis]
            _move(model, data, contact, row, shift, sparse)
            return


@part
def _move(model: int, data: int, contact: int, row: int, shift: Floats, sparse: float) -> None:
    """Move where a contact acts."""
    geoms = integers(contact + AT.contact_geom, 2)
    frame = floats(contact + AT.contact_frame, 9)
    arm, change = np.zeros(3), np.zeros(3)
    for side in range(2):
        geom = geoms[side]
        sign = 1.0 if side == 1 else -1.0
        body = integers(long_at(model + AT.model_bodyid), geom + 1)[geom]
        dof = _last_dof(model, body)
        while dof >= 0:
            spin = floats(long_at(data + AT.cdof) + 48 * dof, 3)
            x = spin[1] * shift[2] - spin[2] * shift[1]
            y = spin[2] * shift[0] - spin[0] * shift[2]
            z = spin[0] * shift[1] - spin[1] * shift[0]
            speed = floats(long_at(data + AT.qvel) + 8 * dof, 1)[0]
            for way in range(3):
                first = 3 * way
                arm[way] = sign * (frame[first] * x + frame[first + 1] * y + frame[first + 2] * z)
                change[way] += arm[way] * speed
            _add(model, data, contact, row, dof, arm, sparse)
            dof = integers(long_at(model + AT.model_dof_parentid), dof + 1)[dof]
    rows = _rows(model)
    mu = floats(contact + AT.contact_friction, 1)[0]
    velocity = floats(long_at(data + AT.velocity) + 8 * row, rows)
    reference = floats(long_at(data + AT.reference) + 8 * row, rows)
    terms = floats(long_at(data + AT.terms) + 32 * row, 4 * rows)
    for place in range(rows):
        more = _part_of(change, place, rows, mu)
        velocity[place] += more
        reference[place] -= terms[4 * place + 1] * more


@part
def _add(
    model: int, data: int, contact: int, row: int, dof: int, arm: Floats, sparse: float
) -> None:
    """Add to a column of a contact's rows."""
    rows = _rows(model)
    mu = floats(contact + AT.contact_friction, 1)[0]
    for place in range(rows):
        at = _place(model, data, row + place, dof, sparse)
        if at >= 0:
            number = floats(long_at(data + AT.jacobian) + 8 * at, 1)
            number[0] += _part_of(arm, place, rows, mu)


@part
def _rows(model: int) -> int:
    """Rows of a contact that normal and friction have: of a cone, or a pyramid's edges."""
    return 3 if integers(model + AT.model_cone, 1)[0] == _ELLIPTIC else 4


@part
def _part_of(ways: Floats, place: int, rows: int, mu: float) -> float:
    """What (normal, first, second) direction are in a row: n ± mu t in a pyramid."""
    if rows == 3:
        return float(ways[place])
    aside = mu * ways[1 + place // 2]
    return float(ways[0] - aside if place % 2 == 1 else ways[0] + aside)


@part
def _place(model: int, data: int, row: int, dof: int, sparse: float) -> int:
    """Where the Jacobian has a row's number for a velocity; -1 if nowhere."""
    if sparse <= 0.0:
        return row * long_at(model + AT.model_nv) + dof
    first = int(integers(long_at(data + AT.rowadr), row + 1)[row])
    count = integers(long_at(data + AT.rownnz), row + 1)[row]
    columns = integers(long_at(data + AT.colind) + 4 * first, count)
    for place in range(count):
        if columns[place] == dof:
            return first + place
    return -1


@part
def _last_dof(model: int, body: int) -> int:
    """The last velocity that moves a body; -1 if none does."""
    while body > 0:
        count = integers(long_at(model + AT.model_dofnum), body + 1)[body]
        if count > 0:
            return int(integers(long_at(model + AT.model_dofadr), body + 1)[body] + count - 1)
        body = integers(long_at(model + AT.model_parentid), body + 1)[body]
    return -1
