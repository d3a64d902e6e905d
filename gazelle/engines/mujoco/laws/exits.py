"""What is let out of an overlap leaves at ``max_vel``, whatever pieces it touches with on its way.

The surfaces of what overlapped are below where they are, and rise (``overlaps``): their contacts
have a margin below zero, which marks them. Of such a body other pieces come to touch as it
moves, at depths that nobody foresaw. MuJoCo's contact wants -B v - K d, v being the velocity at
which two surfaces part and d their distance: so it pushes until v is K d / B. That is bounded.
"""

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.gazelle.engines.mujoco.laws.numbers import EXIT, GEOM_NUMBERS
from cython.cimports.gazelle.engines.mujoco.laws.places import AT
from cython.cimports.gazelle.native.memory import floats, integers, word

_ELLIPTIC = cython.declare(cython.int, 1)  # mjCONE_ELLIPTIC


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def leave_slowly(
    model: cython.size_t, data: cython.size_t, contact: cython.size_t, row: cython.int
) -> cython.void:
    """Bound the velocity at which a contact pushes out what overlapped.

    Args:
        model: Address of the ``mjModel``.
        data: Address of the ``mjData``.
        contact: Address of the ``mjContact``.
        row: Its first row among the constraints.
    """
    if floats(contact + AT.contact_margin)[0] >= 0.0:
        return
    if floats(contact + AT.contact_solref)[0] <= 0.0:
        return  # a spring, or a bounce
    geoms = integers(contact + AT.contact_geom)
    if min(geoms[0], geoms[1]) < 0:
        return
    users = word(model + AT.model_geom_user)
    first = floats(users + 8 * GEOM_NUMBERS * geoms[0])[EXIT]
    second = floats(users + 8 * GEOM_NUMBERS * geoms[1])[EXIT]
    dim = integers(contact + AT.contact_dim)[0]
    cone: cython.bint = dim == 1 or integers(model + AT.model_cone)[0] == _ELLIPTIC
    rows = 1 if cone else 2 * (dim - 1)
    reference = floats(word(data + AT.reference) + 8 * row)
    velocity = floats(word(data + AT.velocity) + 8 * row)
    damping = floats(word(data + AT.terms) + 32 * row)[1]
    wanted, parting = reference[0], velocity[0]
    if rows > 1:
        wanted = 0.5 * (reference[0] + reference[1])
        parting = 0.5 * (velocity[0] + velocity[1])
    excess = wanted + damping * (parting - min(first, second))
    if excess > 0.0:
        for edge in range(rows):
            reference[edge] -= excess
