"""What is let out of an overlap leaves at ``max_vel``, whatever pieces it touches with on its way.

The surfaces of what overlapped are below where they are, and rise (``overlaps``): their contacts
have a margin below zero, which marks them. Of such a body other pieces come to touch as it
moves, at depths that nobody foresaw. MuJoCo's contact wants -B v - K d, v being the velocity at
which two surfaces part and d their distance: so it pushes until v is K d / B. That is bounded.
"""

from __future__ import annotations

from gazelle.engines.mujoco.laws.layouts import offsets
from gazelle.engines.mujoco.laws.numbers import EXIT, GEOM_NUMBERS
from gazelle.engines.native import floats, integers, long_at, part

AT = offsets()

_ELLIPTIC = 1  # mjCONE_ELLIPTIC


@part
def leave_slowly(model: int, data: int, contact: int, row: int) -> None:
    """Bound the velocity at which a contact pushes out what overlapped.

    Args:
        model: Address of the ``mjModel``.
        data: Address of the ``mjData``.
        contact: Address of the ``mjContact``.
        row: Its first row among the constraints.
    """
    if floats(contact + AT.contact_margin, 1)[0] >= 0.0:
        return
    if floats(contact + AT.contact_solref, 1)[0] <= 0.0:
        return  # a spring, or a bounce
    geoms = integers(contact + AT.contact_geom, 2)
    if min(geoms[0], geoms[1]) < 0:
        return
    users = long_at(model + AT.model_geom_user)
    first = floats(users + 8 * GEOM_NUMBERS * geoms[0], GEOM_NUMBERS)[EXIT]
    second = floats(users + 8 * GEOM_NUMBERS * geoms[1], GEOM_NUMBERS)[EXIT]
    dim = integers(contact + AT.contact_dim, 1)[0]
    cone = dim == 1 or integers(model + AT.model_cone, 1)[0] == _ELLIPTIC
    rows = 1 if cone else 2 * (dim - 1)
    reference = floats(long_at(data + AT.reference) + 8 * row, rows)
    velocity = floats(long_at(data + AT.velocity) + 8 * row, rows)
    damping = floats(long_at(data + AT.terms) + 32 * row, 4)[1]
    wanted, parting = reference[0], velocity[0]
    if rows > 1:
        wanted = 0.5 * (reference[0] + reference[1])
        parting = 0.5 * (velocity[0] + velocity[1])
    excess = wanted + damping * (parting - min(first, second))
    if excess > 0.0:
        for edge in range(rows):
            reference[edge] -= excess
