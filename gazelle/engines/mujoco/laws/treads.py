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

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.gazelle.engines.mujoco.laws.numbers import GEOM_NUMBERS, MIDDLE, TREAD
from cython.cimports.gazelle.engines.mujoco.laws.places import AT
from cython.cimports.gazelle.native.memory import floats, integers, word

_ELLIPTIC = cython.declare(cython.int, 1)  # mjCONE_ELLIPTIC

# Sine of the angle from level at which an axle is no wheel's any more.
_STEEP = cython.declare(cython.double, 0.34)

_NEAR = cython.declare(cython.double, 1e-9)  # [m]

# By how much a tread gives way at an edge: ODE's usual surface layer [m].
_GIVES = cython.declare(cython.double, 1e-3)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def stand_in_the_middle(
    model: cython.size_t,
    data: cython.size_t,
    contact: cython.size_t,
    row: cython.int,
    sparse: cython.double,
) -> cython.void:
    """Move a contact with a wheel to the middle of its tread.

    Args:
        model: Address of the ``mjModel``.
        data: Address of the ``mjData``.
        contact: Address of the ``mjContact``.
        row: Its first row among the constraints.
        sparse: Whether Jacobians are.
    """
    if integers(contact + AT.contact_dim)[0] < 3:
        return
    geoms = integers(contact + AT.contact_geom)
    place = floats(contact + AT.contact_pos)
    normal = floats(contact + AT.contact_frame)
    shift = cython.declare(cython.double[3])
    for side in range(2):
        geom = geoms[side]
        if geom < 0:
            continue
        own = floats(word(model + AT.model_geom_user) + 8 * GEOM_NUMBERS * geom)
        joint = cython.cast(cython.int, own[TREAD]) - 1
        if joint < 0:
            continue
        axle = floats(word(data + AT.xaxis) + 24 * joint)
        centre = floats(word(data + AT.geom_xpos) + 24 * geom)
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


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _move(
    model: cython.size_t,
    data: cython.size_t,
    contact: cython.size_t,
    row: cython.int,
    shift: cython.p_double,
    sparse: cython.double,
) -> cython.void:
    """Move where a contact acts."""
    geoms = integers(contact + AT.contact_geom)
    frame = floats(contact + AT.contact_frame)
    arm = cython.declare(cython.double[3])
    change = cython.declare(cython.double[3])
    change[0] = change[1] = change[2] = 0.0
    for side in range(2):
        geom = geoms[side]
        sign = 1.0 if side == 1 else -1.0
        body = integers(word(model + AT.model_bodyid))[geom]
        dof = _last_dof(model, body)
        while dof >= 0:
            spin = floats(word(data + AT.cdof) + 48 * dof)
            x = spin[1] * shift[2] - spin[2] * shift[1]
            y = spin[2] * shift[0] - spin[0] * shift[2]
            z = spin[0] * shift[1] - spin[1] * shift[0]
            speed = floats(word(data + AT.qvel) + 8 * dof)[0]
            for way in range(3):
                first = 3 * way
                arm[way] = sign * (frame[first] * x + frame[first + 1] * y + frame[first + 2] * z)
                change[way] += arm[way] * speed
            _add(model, data, contact, row, dof, arm, sparse)
            dof = integers(word(model + AT.model_dof_parentid))[dof]
    rows = _rows(model)
    mu = floats(contact + AT.contact_friction)[0]
    velocity = floats(word(data + AT.velocity) + 8 * row)
    reference = floats(word(data + AT.reference) + 8 * row)
    terms = floats(word(data + AT.terms) + 32 * row)
    for place in range(rows):
        more = _part_of(change, place, rows, mu)
        velocity[place] += more
        reference[place] -= terms[4 * place + 1] * more


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _add(
    model: cython.size_t,
    data: cython.size_t,
    contact: cython.size_t,
    row: cython.int,
    dof: cython.int,
    arm: cython.p_double,
    sparse: cython.double,
) -> cython.void:
    """Add to a column of a contact's rows."""
    rows = _rows(model)
    mu = floats(contact + AT.contact_friction)[0]
    for place in range(rows):
        at = _place(model, data, row + place, dof, sparse)
        if at >= 0:
            number = floats(word(data + AT.jacobian) + 8 * at)
            number[0] += _part_of(arm, place, rows, mu)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _rows(model: cython.size_t) -> cython.int:
    """Rows of a contact that normal and friction have: of a cone, or a pyramid's edges."""
    return 3 if integers(model + AT.model_cone)[0] == _ELLIPTIC else 4


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _part_of(
    ways: cython.p_double, place: cython.int, rows: cython.int, mu: cython.double
) -> cython.double:
    """What (normal, first, second) direction are in a row: n ± mu t in a pyramid."""
    if rows == 3:
        return ways[place]
    aside = mu * ways[1 + place // 2]
    return ways[0] - aside if place % 2 == 1 else ways[0] + aside


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _place(
    model: cython.size_t,
    data: cython.size_t,
    row: cython.int,
    dof: cython.int,
    sparse: cython.double,
) -> cython.int:
    """Where the Jacobian has a row's number for a velocity; -1 if nowhere."""
    if sparse <= 0.0:
        return row * cython.cast(cython.int, word(model + AT.model_nv)) + dof
    first = integers(word(data + AT.rowadr))[row]
    count = integers(word(data + AT.rownnz))[row]
    columns = integers(word(data + AT.colind) + 4 * first)
    for place in range(count):
        if columns[place] == dof:
            return first + place
    return -1


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _last_dof(model: cython.size_t, body: cython.int) -> cython.int:
    """The last velocity that moves a body; -1 if none does."""
    while body > 0:
        count = integers(word(model + AT.model_dofnum))[body]
        if count > 0:
            return integers(word(model + AT.model_dofadr))[body] + count - 1
        body = integers(word(model + AT.model_parentid))[body]
    return -1
