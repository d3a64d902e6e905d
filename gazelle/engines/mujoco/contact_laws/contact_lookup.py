"""Look up what laws need of a step and of a contact, once for all of them (``Touch``)."""

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.gazelle.engines.mujoco.contact_laws.contact_data import Touch
from cython.cimports.gazelle.engines.mujoco.contact_laws.struct_offsets import AT
from cython.cimports.gazelle.native.memory import floats, integers, word
from cython.cimports.libc.math import sqrt

_ELLIPTIC = cython.declare(cython.int, 1)  # mjCONE_ELLIPTIC


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def begin_step(
    touch: cython.pointer[Touch], model: cython.size_t, data: cython.size_t
) -> cython.void:
    """Look up the data of all contacts of a step."""
    gravity = floats(model + AT.model_gravity)
    touch.model, touch.data = model, data
    touch.users = word(model + AT.model_geom_user)
    touch.step = floats(model + AT.model_timestep)[0]
    touch.weight = sqrt(gravity[0] * gravity[0] + gravity[1] * gravity[1] + gravity[2] * gravity[2])
    touch.cone = integers(model + AT.model_cone)[0] == _ELLIPTIC
    touch.sparse = floats(word(model + AT.model_numeric))[1] > 0.0
    touch.width = cython.cast(cython.int, word(model + AT.model_nv))
    touch.velocities, touch.references = word(data + AT.velocity), word(data + AT.reference)
    touch.all_terms, touch.jacobians = word(data + AT.terms), word(data + AT.jacobian)
    touch.before = floats(word(data + AT.warmstart))


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def begin_contact(touch: cython.pointer[Touch], contact: cython.size_t) -> cython.bint:
    """Look up the data of a contact for the laws; returns whether it has any rows."""
    row: cython.int = integers(contact + AT.contact_address)[0]
    if row < 0:
        return False
    touch.contact, touch.row = contact, row
    touch.dim = integers(contact + AT.contact_dim)[0]
    touch.geoms = integers(contact + AT.contact_geom)
    touch.frame = floats(contact + AT.contact_frame)
    touch.friction = floats(contact + AT.contact_friction)
    touch.velocity = floats(touch.velocities + 8 * row)
    touch.reference = floats(touch.references + 8 * row)
    touch.terms = floats(touch.all_terms + 32 * row)
    if touch.sparse:
        first: cython.size_t = integers(word(touch.data + AT.rowadr))[row]
        touch.width = integers(word(touch.data + AT.rownnz))[row]
        touch.columns = integers(word(touch.data + AT.colind) + 4 * first)
        touch.jacobian = floats(touch.jacobians + 8 * first)
    else:
        touch.jacobian = floats(touch.jacobians + 8 * cython.cast(cython.size_t, row * touch.width))
    return True
