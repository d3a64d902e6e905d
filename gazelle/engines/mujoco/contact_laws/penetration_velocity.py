"""Bound on the velocity of penetration recovery, whatever pieces a body touches on its way.

The surfaces of what overlapped are below where they are, and rise (``penetration_recovery``): their contacts
have a margin below zero, which marks them. Of such a body other pieces come to touch as it
moves, at depths that were not foreseen. MuJoCo's contact wants -B v - K d, v being the velocity at
which two surfaces part and d their distance: so it pushes until v is K d / B. That is bounded.
"""

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.gazelle.engines.mujoco.contact_laws.contact_data import Touch
from cython.cimports.gazelle.engines.mujoco.contact_laws.law_data_indices import EXIT, GEOM_NUMBERS
from cython.cimports.gazelle.engines.mujoco.contact_laws.struct_offsets import AT
from cython.cimports.gazelle.native.memory import floats


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def leave_slowly(touch: cython.pointer[Touch]) -> cython.void:
    """Bound the velocity at which a contact pushes out what overlapped."""
    if floats(touch.contact + AT.contact_margin)[0] >= 0.0:
        return
    if floats(touch.contact + AT.contact_solref)[0] <= 0.0:
        return  # a spring, or a bounce
    if min(touch.geoms[0], touch.geoms[1]) < 0:
        return
    first = floats(touch.users + 8 * GEOM_NUMBERS * touch.geoms[0])[EXIT]
    second = floats(touch.users + 8 * GEOM_NUMBERS * touch.geoms[1])[EXIT]
    rows = 1 if touch.dim == 1 or touch.cone else 2 * (touch.dim - 1)
    wanted, parting = touch.reference[0], touch.velocity[0]
    if rows > 1:
        wanted = 0.5 * (touch.reference[0] + touch.reference[1])
        parting = 0.5 * (touch.velocity[0] + touch.velocity[1])
    excess = wanted + touch.terms[1] * (parting - min(first, second))
    if excess > 0.0:
        for edge in range(rows):
            touch.reference[edge] -= excess
