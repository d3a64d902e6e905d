"""Contacts that slide do not part, and rub against their motion: Coulomb's law.

MuJoCo's friction is convex. With J the contact's Jacobian, a the acceleration and aref what the
contact wants, it finds forces such that of r = J a - aref, a contact that slides has
r_n = mu |r_t|: the normal velocity grows with the slip, and what slides flies. Coulomb's law
wants r_n = 0. As r_n counts from aref_n, taking mu |r_t| off aref_n gives just that (de Saxcé
and Feng 1998; Acary, Cadoux, Lemaréchal and Malick 2011). r_t follows from forces that are not
known yet, but the accelerations of the last step determine it: along the slip it is
positive where friction cannot stop the slip in this step, and zero where it can, so that what
holds is left alone.

An error e of that estimate makes the next one wrong by e mu² k / (1 + mu² k), k being the ratio
of the contact's inverse inertias along the slip and the normal (1 for a block, 7/2 for a ball).
So errors die out, for every mu. The normal acceleration that the last step lacked determines more:
with k known, the estimate would be exact at once. Some of that is taken, which damps for all k;
in an impact all of it, with k = 1.

An estimate that is wrong for a step unloads a contact, and what stands on others besides may stay
there: on a caster, with wheels that do not grip. So contacts of robots, and of hollow meshes, are
left alone while they slip so little that they may only creep. A free body of one friction has no
such others, and is kept down however slowly it slides. Else it rises by mu times its slip, loses contact, and with it
all friction of a step: 0.2 % of it on a slope, half of it where it is pushed at 1 mm/s.
"""

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.gazelle.engines.mujoco.contact_laws.contact_data import Touch
from cython.cimports.gazelle.engines.mujoco.contact_laws.free_fall import fall, never_moved
from cython.cimports.gazelle.engines.mujoco.contact_laws.law_data_indices import ALIKE, GEOM_NUMBERS
from cython.cimports.gazelle.engines.mujoco.contact_laws.struct_offsets import AT
from cython.cimports.gazelle.native.memory import floats
from cython.cimports.libc.math import sqrt

# Slower slip parts the surfaces by some nanometres a step [m/s].
_LEAST_SLIP = cython.declare(cython.double, 1e-4)

# Slower creep has no direction [m/s].
_LEAST_CREEP = cython.declare(cython.double, 1e-6)

# Square of the sine of a slope below which there is none.
_LEVEL = cython.declare(cython.double, 1e-12)

# What holds creeps, at less than this share of what friction takes off a slip in a step when
# only the weight presses.
_CREEP = cython.declare(cython.double, 0.25)

# What friction stops in this number of steps, when only the weight presses, slides slowly. One is the
# least at which a point keeps its direction on a pyramid's edge, 1.5 at which a box does.
_STEPS_TO_STOP = cython.declare(cython.double, 2.0)

# Half the width of a blunt pyramid's side, over its distance from the axis. With a fifth of this
# what slides slowly is steered by rounding all the same.
_BLUNT = cython.declare(cython.double, 0.5)

# With more friction, what slides jams or tumbles rather; the estimate would be late.
_MOST_FRICTION = cython.declare(cython.double, 5.0)

# Normal acceleration that makes an impact, in weights; and in free fall [m/s²].
_IMPACT = cython.declare(cython.double, 4.0)
_LEAST_IMPACT = cython.declare(cython.double, 4.0)

# Largest share, times mu², of the normal acceleration that the last step lacked.
_DAMPED = cython.declare(cython.double, 0.25)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def stay_down(touch: cython.pointer[Touch]) -> cython.void:
    """Set a sliding contact's normal velocity to that of one that holds."""
    if touch.dim < 3:
        return
    if touch.cone:
        _on_a_cone(touch)
    elif touch.friction[0] > 0.0:
        _on_a_pyramid(touch)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _on_a_cone(touch: cython.pointer[Touch]) -> cython.void:
    friction, velocity, reference = touch.friction, touch.velocity, touch.reference
    along, across = friction[0] * velocity[1], friction[1] * velocity[2]
    size, most = sqrt(along * along + across * across), max(friction[0], friction[1])
    if most <= 0.0:
        return
    share = _share(touch, size / most, most)
    if share == 0.0:
        if size < _LEAST_CREEP and friction[0] == friction[1]:
            reference[0] -= _first_parting(touch, friction[0])
        return
    along, across = friction[0] * along / size, friction[1] * across / size
    gained = along * _last(touch, 1) + across * _last(touch, 2)
    wanted = along * reference[1] + across * reference[2]
    lacking = reference[0] - _last(touch, 0)
    mu = sqrt(along * along + across * across)
    left = _lasting(touch, gained, size, _is_alike(touch)) - wanted
    reference[0] -= share * _parting(touch, left, lacking, mu)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _on_a_pyramid(touch: cython.pointer[Touch]) -> cython.void:
    """Set the edges n ± mu t of a pyramid likewise, two for each direction.

    It is turned first so that one direction is that of the slip; else friction would be up to
    a factor of sqrt(2) too small, and aslant.
    """
    mu, velocity, reference = touch.friction[0], touch.velocity, touch.reference
    one, two = 0.5 * (velocity[0] - velocity[1]) / mu, 0.5 * (velocity[2] - velocity[3]) / mu
    slip = sqrt(one * one + two * two)
    if slip < _LEAST_CREEP:
        _begin_on_a_pyramid(touch, mu)
        return
    _turn_pyramid(touch, one / slip, two / slip)
    share = _share(touch, slip, mu)
    if share == 0.0:
        return
    alike = _is_alike(touch)
    left, lacking = 0.0, 0.0
    for edge in range(0, 4, 2):
        first, second = _last(touch, edge), _last(touch, edge + 1)
        sign = 0.5 if velocity[edge] > velocity[edge + 1] else -0.5
        wanted = sign * (reference[edge] - reference[edge + 1])
        gained = _lasting(touch, sign * (first - second), mu * slip, alike)
        left = max(left, gained - wanted)
        lacking = 0.5 * (reference[edge] + reference[edge + 1] - first - second)
    parting = share * _parting(touch, left, lacking, mu)
    for edge in range(2 * (touch.dim - 1)):
        reference[edge] -= parting
    if slip < _STEPS_TO_STOP * mu * touch.weight * touch.step and alike:
        _blunt_pyramid(touch)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _begin_on_a_pyramid(touch: cython.pointer[Touch], mu: cython.double) -> cython.void:
    """Turn a pyramid without slip to where gravity pulls: that is how it will slide."""
    if _is_level(touch):
        return
    one, two = fall(touch, 1), fall(touch, 2)
    pull = sqrt(one * one + two * two)
    if pull == 0.0:
        return
    parting = _first_parting(touch, mu)
    _turn_pyramid(touch, one / pull, two / pull)
    for edge in range(2 * (touch.dim - 1)):
        touch.reference[edge] -= parting
    if _is_alike(touch):
        _blunt_pyramid(touch)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _is_level(touch: cython.pointer[Touch]) -> cython.bint:
    """Return whether gravity acts along the normal of a contact alone."""
    gravity = floats(touch.model + AT.model_gravity)
    along, square = 0.0, 0.0
    for axis in range(3):
        along += gravity[axis] * touch.frame[axis]
        square += gravity[axis] * gravity[axis]
    return square - along * along <= _LEVEL * square


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _first_parting(touch: cython.pointer[Touch], mu: cython.double) -> cython.double:
    """Return the normal acceleration that MuJoCo would add in the first step of sliding.

    Nothing is known of a last step. Gravity alone pulls, though: what that exceeds friction by
    is how much faster the slip will get.
    """
    if mu > _MOST_FRICTION or _is_level(touch) or not never_moved(touch):
        return 0.0
    one, two, press = fall(touch, 1), fall(touch, 2), -fall(touch, 0)
    if press <= 0.0:
        return 0.0  # what holds it is not its weight
    return max(mu * (sqrt(one * one + two * two) - mu * press), 0.0)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _share(
    touch: cython.pointer[Touch], slip: cython.double, friction: cython.double
) -> cython.double:
    """Return to what share a contact that slips slides: 0 as long as it may only creep."""
    if friction > _MOST_FRICTION or slip < _LEAST_CREEP:
        return 0.0
    if _is_alike(touch):
        return 1.0
    if slip < _LEAST_SLIP:
        return 0.0
    creep = max(_LEAST_SLIP, _CREEP * friction * touch.weight * touch.step)
    return min(max(slip / creep - 1.0, 0.0), 1.0)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _is_alike(touch: cython.pointer[Touch]) -> cython.bint:
    """Return whether all contacts of both bodies have the same, isotropic friction."""
    if touch.friction[0] != touch.friction[1] or min(touch.geoms[0], touch.geoms[1]) < 0:
        return False
    if floats(touch.contact + AT.contact_margin)[0] < 0.0:
        return False  # it leaves an overlap, at the velocity that ``penetration_velocity`` allows
    first = floats(touch.users + 8 * GEOM_NUMBERS * touch.geoms[0])[ALIKE]
    second = floats(touch.users + 8 * GEOM_NUMBERS * touch.geoms[1])[ALIKE]
    return first > 0.0 and second > 0.0


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _lasting(
    touch: cython.pointer[Touch],
    gained: cython.double,
    slip: cython.double,
    alike: cython.bint,
) -> cython.double:
    """Return the acceleration along the slip to expect after that of the last step.

    A motor that got a new command makes a wheel slip within one step, and not more so in the next.
    What gained its slip in n steps of the same acceleration keeps (n - 1) / n of that.

    Args:
        touch: The contact.
        gained: Acceleration along the slip in the last step, times mu.
        slip: Slip, times mu.
        alike: Whether all contacts of both bodies have the same, isotropic friction.
    """
    if gained <= 0.0 or alike:
        return gained
    return gained * max(1.0 - gained * touch.step / slip, 0.0)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _parting(
    touch: cython.pointer[Touch], left: cython.double, lacking: cython.double, mu: cython.double
) -> cython.double:
    """Return the normal acceleration that MuJoCo would add to sliding bodies.

    Args:
        touch: The contact.
        left: mu times the acceleration along the slip by which friction will miss what it wants.
        lacking: The normal acceleration that is wanted beyond the last step's.
        mu: Friction along the slip.
    """
    square = mu * mu
    if abs(lacking) < max(_IMPACT * touch.weight, _LEAST_IMPACT):
        square = min(square, _DAMPED)
    return max(left - square * lacking, 0.0)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _turn_pyramid(
    touch: cython.pointer[Touch], one: cython.double, two: cython.double
) -> cython.void:
    """Turn a pyramid's first direction to (one, two), with all data of its edges."""
    frame = touch.frame
    for axis in range(3):
        a, b = frame[3 + axis], frame[6 + axis]
        frame[3 + axis] = one * a + two * b
        frame[6 + axis] = one * b - two * a
    _turn_edges(touch.velocity, 1, one, two)
    _turn_edges(touch.reference, 1, one, two)
    _turn_edges(touch.jacobian, touch.width, one, two)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _blunt_pyramid(touch: cython.pointer[Touch]) -> cython.void:
    """Blunt an edge of a pyramid to a narrow side: n ± mu (t ± _BLUNT s), as far from its axis.

    An edge bears nothing across itself. So what slides along one is steered by the direction of its
    slip, which rounding decides: where that is slow, by more in a step than all of the slip. A side
    holds what is across the slip, and friction along it is the same.
    """
    frame = touch.frame
    for axis in range(3, 6):
        along, across = frame[axis], _BLUNT * frame[3 + axis]
        frame[axis], frame[3 + axis] = along + across, along - across
    _blunt_edges(touch.velocity, 1)
    _blunt_edges(touch.reference, 1)
    _blunt_edges(touch.jacobian, touch.width)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _blunt_edges(array: cython.p_double, width: cython.int) -> cython.void:
    """Blunt the numbers of four edges, each of which has ``width`` of them."""
    for first in range(width):
        second, third, fourth = first + width, first + 2 * width, first + 3 * width
        normal = 0.5 * (array[first] + array[second])
        along = 0.5 * (array[first] - array[second])
        across = 0.5 * _BLUNT * (array[third] - array[fourth])
        array[first], array[second] = normal + (along + across), normal - (along + across)
        array[third], array[fourth] = normal + (along - across), normal - (along - across)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _turn_edges(
    array: cython.p_double, width: cython.int, one: cython.double, two: cython.double
) -> cython.void:
    """Turn the numbers of four edges, n ± t1 and n ± t2, each of which has ``width`` of them."""
    for first in range(width):
        second, third, fourth = first + width, first + 2 * width, first + 3 * width
        normal = 0.5 * (array[first] + array[second])
        a = 0.5 * (array[first] - array[second])
        b = 0.5 * (array[third] - array[fourth])
        array[first], array[second] = normal + (one * a + two * b), normal - (one * a + two * b)
        array[third], array[fourth] = normal + (one * b - two * a), normal - (one * b - two * a)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _last(touch: cython.pointer[Touch], row: cython.int) -> cython.double:
    """Return the acceleration of the last step along one of the contact's rows."""
    found = 0.0
    first = row * touch.width
    if touch.sparse:
        for place in range(touch.width):
            found += touch.jacobian[first + place] * touch.before[touch.columns[place]]
    else:
        for place in range(touch.width):
            found += touch.jacobian[first + place] * touch.before[place]
    return found
