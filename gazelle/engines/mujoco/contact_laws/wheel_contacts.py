"""Wheel contacts at the middle of the tread instead of at its edges.

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

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.gazelle.engines.mujoco.contact_laws.contact_data import Touch
from cython.cimports.gazelle.engines.mujoco.contact_laws.law_data_indices import (
    GEOM_NUMBERS,
    MARK,
    MIDDLE,
    TREAD,
)
from cython.cimports.gazelle.engines.mujoco.contact_laws.struct_offsets import AT
from cython.cimports.gazelle.native.memory import floats, integers, word

# Sine of the angle from level at which an axle is not a wheel's any more.
_STEEP = cython.declare(cython.double, 0.34)

_NEAR = cython.declare(cython.double, 1e-9)  # [m]

# By how much a tread gives way at an edge: ODE's usual surface layer [m].
_GIVES = cython.declare(cython.double, 1e-3)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def stand_in_the_middle(touch: cython.pointer[Touch]) -> cython.void:
    """Move a contact with a wheel to the middle of its tread."""
    if touch.dim < 3:
        return
    place = floats(touch.contact + AT.contact_pos)
    shift = cython.declare(cython.double[3])
    for side in range(2):
        geom = touch.geoms[side]
        if geom < 0:
            continue
        own = floats(touch.users + 8 * GEOM_NUMBERS * geom)
        joint = cython.cast(cython.int, own[TREAD]) - 1
        if joint < 0:
            continue
        axle = floats(word(touch.data + AT.xaxis) + 24 * joint)
        centre = floats(word(touch.data + AT.geom_xpos) + 24 * geom)
        along, lean = -own[MIDDLE], 0.0
        for axis in range(3):
            along += (place[axis] - centre[axis]) * axle[axis]
            lean += touch.frame[axis] * axle[axis]
        share = 1.0 - abs(lean * along) / _GIVES
        if share > 0.0 and abs(lean) < _STEEP and abs(along) > _NEAR:
            for axis in range(3):
                shift[axis] = -share * along * axle[axis]
                place[axis] += shift[axis]
            _move(touch, shift)
            return


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def is_upright_wheel(
    model: cython.size_t, geom: cython.int, lean: cython.double, half: cython.double
) -> cython.bint:
    """Return whether a cylinder is an upright wheel, which contacts the ground at its middle.

    Args:
        model: Address of the ``mjModel``.
        geom: The cylinder.
        lean: Sine of the angle between its axis and the ground.
        half: Half its length [m].
    """
    if word(model + AT.model_nnumeric) == 0:
        return False
    head = floats(word(model + AT.model_numeric))
    if head[0] != MARK or head[5] == 0.0:
        return False
    own = floats(word(model + AT.model_geom_user) + 8 * GEOM_NUMBERS * geom)
    return own[TREAD] > 0.0 and abs(lean) < _STEEP and abs(lean) * half < _GIVES


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _move(touch: cython.pointer[Touch], shift: cython.p_double) -> cython.void:
    """Move where a contact acts."""
    bodies = integers(word(touch.model + AT.model_bodyid))
    parents = integers(word(touch.model + AT.model_dof_parentid))
    speeds, frame = floats(word(touch.data + AT.qvel)), touch.frame
    arm = cython.declare(cython.double[3])
    change = cython.declare(cython.double[3])
    parts = cython.declare(cython.double[4])
    change[0] = change[1] = change[2] = 0.0
    for side in range(2):
        sign = 1.0 if side == 1 else -1.0
        dof = _last_dof(touch.model, bodies[touch.geoms[side]])
        while dof >= 0:
            spin = floats(word(touch.data + AT.cdof) + 48 * dof)
            x = spin[1] * shift[2] - spin[2] * shift[1]
            y = spin[2] * shift[0] - spin[0] * shift[2]
            z = spin[0] * shift[1] - spin[1] * shift[0]
            if x != 0.0 or y != 0.0 or z != 0.0:
                for way in range(3):
                    first = 3 * way
                    arm[way] = sign * (
                        frame[first] * x + frame[first + 1] * y + frame[first + 2] * z
                    )
                    change[way] += arm[way] * speeds[dof]
                column = _column(touch, dof)
                if column >= 0:
                    rows = _by_rows(touch, arm, parts)
                    for row in range(rows):
                        touch.jacobian[row * touch.width + column] += parts[row]
            dof = parents[dof]
    rows = _by_rows(touch, change, parts)
    for row in range(rows):
        touch.velocity[row] += parts[row]
        touch.reference[row] -= touch.terms[4 * row + 1] * parts[row]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _by_rows(
    touch: cython.pointer[Touch], ways: cython.p_double, parts: cython.p_double
) -> cython.int:
    """Transform (normal, first, second) directions to the rows of sliding: n ± mu t in a pyramid.

    Returns:
        How many rows that are.
    """
    if touch.cone:
        for way in range(3):
            parts[way] = ways[way]
        return 3
    first, second = touch.friction[0] * ways[1], touch.friction[0] * ways[2]
    parts[0], parts[1] = ways[0] + first, ways[0] - first
    parts[2], parts[3] = ways[0] + second, ways[0] - second
    return 4


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _column(touch: cython.pointer[Touch], dof: cython.int) -> cython.int:
    """Return the index of a velocity in rows of the Jacobian; -1 if it is absent."""
    if not touch.sparse:
        return dof
    for column in range(touch.width):
        if touch.columns[column] == dof:
            return column
    return -1


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _last_dof(model: cython.size_t, body: cython.int) -> cython.int:
    """Return the last velocity that moves a body; -1 without one."""
    while body > 0:
        count = integers(word(model + AT.model_dofnum))[body]
        if count > 0:
            return integers(word(model + AT.model_dofadr))[body] + count - 1
        body = integers(word(model + AT.model_parentid))[body]
    return -1
