"""Free acceleration of two touching surfaces under gravity."""

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.gazelle.engines.mujoco.contact_laws.contact_data import Touch
from cython.cimports.gazelle.engines.mujoco.contact_laws.struct_offsets import AT
from cython.cimports.gazelle.native.memory import floats, integers, word

_FREE = cython.declare(cython.int, 0)  # mjJNT_FREE


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def fall(touch: cython.pointer[Touch], way: cython.int) -> cython.double:
    """Return the acceleration at which free bodies would part along an axis of a contact's frame.

    Args:
        touch: The contact.
        way: 0 for the normal, 1 and 2 for the directions across it.
    """
    gravity = floats(touch.model + AT.model_gravity)
    along = 0.0
    for side in range(2):
        body: cython.int = integers(word(touch.model + AT.model_bodyid))[touch.geoms[side]]
        if _free_velocity(touch, body) < 0:
            continue
        borne = floats(word(touch.model + AT.model_gravcomp))[body]
        sign = -1.0 if side == 0 else 1.0
        for axis in range(3):
            along += sign * (1.0 - borne) * gravity[axis] * touch.frame[3 * way + axis]
    return along


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def never_moved(touch: cython.pointer[Touch]) -> cython.bint:
    """Return whether this is a free body's first step, so that there is no acceleration of the last."""
    for side in range(2):
        body: cython.int = integers(word(touch.model + AT.model_bodyid))[touch.geoms[side]]
        first = _free_velocity(touch, body)
        if first < 0:
            continue
        for dof in range(first, first + 3):
            if touch.before[dof] != 0.0:
                return False
    return True


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _free_velocity(touch: cython.pointer[Touch], body: cython.int) -> cython.int:
    """Return the first of the six velocities of the free body that carries a body.

    -1 without one.
    """
    model = touch.model
    root = integers(word(model + AT.model_rootid))[body]
    if integers(word(model + AT.model_jntnum))[root] == 0:
        return -1
    joint = integers(word(model + AT.model_jntadr))[root]
    if integers(word(model + AT.model_jnt_type))[joint] != _FREE:
        return -1
    return integers(word(model + AT.model_jnt_dofadr))[joint]
