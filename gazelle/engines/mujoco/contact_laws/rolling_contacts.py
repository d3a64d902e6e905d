"""Softer friction constraints for rolling contacts.

Friction is stiff, so that what is held does not creep (``surfaces.stiffen_friction``). Two wheels on an
axle that turn as their robot's do hold it aside at two points of one rigid body, though, and by
velocities that differ in the seventh digit. Friction that stiff makes such differences into
forces as large as friction may have, and the solver searches for where it gives way. What rolls
comes to lie on other points all the time, of which none can be said to creep. So its friction
is softer: it still gives way a hundred times less than MuJoCo's usual friction.
"""

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.gazelle.engines.mujoco.contact_laws.contact_data import Touch
from cython.cimports.gazelle.engines.mujoco.contact_laws.struct_offsets import AT
from cython.cimports.gazelle.native.memory import floats, integers, word
from cython.cimports.libc.math import log, pow, sqrt  # noqa: A004

# What turns slower on a surface lies there, and what turns faster rolls [rad/s].
_LIES = cython.declare(cython.double, 0.01)
_ROLLS = cython.declare(cython.double, 0.05)

# How many times stiffer friction is than the normal direction where a contact rolls.
_RATIO = cython.declare(cython.double, 10.0)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def hold_loosely(touch: cython.pointer[Touch]) -> cython.void:
    """Set the friction of a contact in a cone to creep more, the faster it rolls."""
    if touch.dim < 3 or not touch.cone:
        return
    rate = _rolling(touch)
    if rate <= _LIES:
        return
    stiff = floats(touch.model + AT.model_impratio)[0] / _RATIO
    share = min(log(rate / _LIES) / log(_ROLLS / _LIES), 1.0)
    softer = pow(stiff, share)
    softness = floats(word(touch.data + AT.softness) + 8 * touch.row)
    stiffness = floats(word(touch.data + AT.stiffness) + 8 * touch.row)
    for way in range(1, touch.dim):
        softness[way] *= softer
        stiffness[way] /= softer
    floats(touch.contact + AT.contact_mu)[0] *= sqrt(softer)
    if integers(touch.data + AT.nisland)[0] > 0:
        _tell_the_island(touch)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _tell_the_island(touch: cython.pointer[Touch]) -> cython.void:
    """Copy what was changed for the solver, which has its own rows where it works by islands.

    MuJoCo fills those before any law acts. A cone whose ``mu`` does not fit its rows would rub with
    more than Coulomb's force.
    """
    places = integers(word(touch.data + AT.to_island) + 4 * touch.row)
    for way in range(1, touch.dim):
        row = 8 * (touch.row + way)
        there = 8 * cython.cast(cython.size_t, places[way])
        floats(word(touch.data + AT.island_softness) + there)[0] = floats(
            word(touch.data + AT.softness) + row
        )[0]
        floats(word(touch.data + AT.island_stiffness) + there)[0] = floats(
            word(touch.data + AT.stiffness) + row
        )[0]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _rolling(touch: cython.pointer[Touch]) -> cython.double:
    """Return the speed of one surface turning on another, about axes in both [rad/s]."""
    if min(touch.geoms[0], touch.geoms[1]) < 0:
        return 0.0
    bodies = integers(word(touch.model + AT.model_bodyid))
    first = floats(word(touch.data + AT.cvel) + 48 * bodies[touch.geoms[0]])
    second = floats(word(touch.data + AT.cvel) + 48 * bodies[touch.geoms[1]])
    square, spin = 0.0, 0.0
    for axis in range(3):
        turn = second[axis] - first[axis]
        square += turn * turn
        spin += turn * touch.frame[axis]
    return sqrt(max(square - spin * spin, 0.0))
