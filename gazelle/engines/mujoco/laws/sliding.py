"""Contacts that slide do not part, and rub against their motion: Coulomb's law.

MuJoCo's friction is convex. With J the contact's Jacobian, a the acceleration and aref what the
contact wants, it finds forces such that of r = J a - aref, a contact that slides has
r_n = mu |r_t|: the normal velocity grows with the slip, and what slides flies. Coulomb's law
wants r_n = 0. As r_n counts from aref_n, taking mu |r_t| off aref_n gives just that (de Saxcé
and Feng 1998; Acary, Cadoux, Lemaréchal and Malick 2011). r_t follows from forces that are not
known yet, but the accelerations of the last step tell what it will be: along the slip it is
positive where friction cannot stop the slip in this step, and zero where it can, so that what
holds is left alone.

An error e of that estimate makes the next one wrong by e mu² k / (1 + mu² k), k being the ratio
of the contact's inverse inertias along the slip and the normal (1 for a block, 7/2 for a ball).
So errors die out, for every mu. The normal acceleration that the last step lacked tells more:
with k known, the estimate would be exact at once. Some of that is taken, which damps for all k;
in an impact all of it, with k = 1.
"""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from gazelle.engines.mujoco.laws.layouts import offsets
from gazelle.engines.native import floats, integers, long_at, part

Floats: TypeAlias = NDArray[np.float64]

AT = offsets()

# Slower slip parts the surfaces by some nanometres a step [m/s].
_LEAST_SLIP = 1e-4

# Slower creep has no direction [m/s].
_LEAST_CREEP = 1e-6

# What holds creeps, at less than this share of what friction takes off a slip in a step when
# only the weight presses.
_CREEP = 0.25

# With more friction, what slides jams or tumbles rather; the estimate would be late.
_MOST_FRICTION = 5.0

# Normal acceleration that makes an impact, in weights; and in free fall [m/s²].
_IMPACT, _LEAST_IMPACT = 4.0, 4.0

# Largest share, times mu², of the normal acceleration that the last step lacked.
_DAMPED = 0.25

_ELLIPTIC = 1  # mjCONE_ELLIPTIC


@part
def stay_down(model: int, data: int, contact: int, row: int, sparse: float) -> None:
    """Let a contact that slides want no other normal velocity than one that holds.

    Args:
        model: Address of the ``mjModel``.
        data: Address of the ``mjData``.
        contact: Address of the ``mjContact``.
        row: Its first row among the constraints.
        sparse: Whether Jacobians are.
    """
    dim = integers(contact + AT.contact_dim, 1)[0]
    friction = floats(contact + AT.contact_friction, 1)[0]
    if dim < 3:
        return
    if integers(model + AT.model_cone, 1)[0] == _ELLIPTIC:
        _on_a_cone(model, data, contact, row, sparse)
    elif friction > 0.0:
        _on_a_pyramid(model, data, contact, row, 2 * (dim - 1), sparse)


@part
def _on_a_cone(model: int, data: int, contact: int, row: int, sparse: float) -> None:
    friction = floats(contact + AT.contact_friction, 2)
    velocity = floats(long_at(data + AT.velocity) + 8 * row, 3)
    along, across = friction[0] * velocity[1], friction[1] * velocity[2]
    size, most = math.sqrt(along * along + across * across), max(friction[0], friction[1])
    if most <= 0.0:
        return
    share = _share(model, size / most, most)
    if share == 0.0:
        return
    reference = floats(long_at(data + AT.reference) + 8 * row, 3)
    along, across = friction[0] * along / size, friction[1] * across / size
    one = _last(model, data, row + 1, sparse) - reference[1]
    two = _last(model, data, row + 2, sparse) - reference[2]
    lacking = reference[0] - _last(model, data, row, sparse)
    mu = math.sqrt(along * along + across * across)
    reference[0] -= share * _parting(model, along * one + across * two, lacking, mu)


@part
def _on_a_pyramid(model: int, data: int, contact: int, row: int, edges: int, sparse: float) -> None:
    """The same for the edges n ± mu t of a pyramid, two for each direction.

    It is turned first so that one direction is that of the slip; else friction would be up to
    a factor of sqrt(2) too small, and aslant.
    """
    mu = floats(contact + AT.contact_friction, 1)[0]
    velocity = floats(long_at(data + AT.velocity) + 8 * row, 4)
    one, two = 0.5 * (velocity[0] - velocity[1]) / mu, 0.5 * (velocity[2] - velocity[3]) / mu
    slip = math.sqrt(one * one + two * two)
    if slip < _LEAST_CREEP:
        return
    _turn_pyramid(model, data, contact, row, one / slip, two / slip, sparse)
    share = _share(model, slip, mu)
    if share == 0.0:
        return
    reference = floats(long_at(data + AT.reference) + 8 * row, edges)
    left, lacking = 0.0, 0.0
    for edge in range(0, 4, 2):
        first, second = (
            _last(model, data, row + edge, sparse) - reference[edge],
            _last(model, data, row + edge + 1, sparse) - reference[edge + 1],
        )
        more = 0.5 * (first - second)
        left = max(left, more if velocity[edge] > velocity[edge + 1] else -more)
        lacking = -0.5 * (first + second)
    parting = share * _parting(model, left, lacking, mu)
    for edge in range(edges):
        reference[edge] -= parting


@part
def _share(model: int, slip: float, friction: float) -> float:
    """To what share a contact that slips at a speed slides: 0 as long as it may only creep."""
    if slip < _LEAST_SLIP or friction > _MOST_FRICTION:
        return 0.0
    step = floats(model + AT.model_timestep, 1)[0]
    creep = max(_LEAST_SLIP, _CREEP * friction * _weight(model) * step)
    return float(min(max(slip / creep - 1.0, 0.0), 1.0))


@part
def _parting(model: int, left: float, lacking: float, mu: float) -> float:
    """The normal acceleration that MuJoCo would add to what slides.

    Args:
        model: Address of the ``mjModel``.
        left: mu times the acceleration along the slip by which friction will miss what it wants.
        lacking: The normal acceleration that is wanted beyond the last step's.
        mu: Friction along the slip.
    """
    square = mu * mu
    if abs(lacking) < max(_IMPACT * _weight(model), _LEAST_IMPACT):
        square = min(square, _DAMPED)
    return max(left - square * lacking, 0.0)


@part
def _weight(model: int) -> float:
    gravity = floats(model + AT.model_gravity, 3)
    return math.sqrt(gravity[0] ** 2 + gravity[1] ** 2 + gravity[2] ** 2)


@part
def _turn_pyramid(
    model: int, data: int, contact: int, row: int, one: float, two: float, sparse: float
) -> None:
    """Turn a pyramid's first direction to (one, two), with all that is known of its edges."""
    frame = floats(contact + AT.contact_frame, 9)
    for axis in range(3):
        a, b = frame[3 + axis], frame[6 + axis]
        frame[3 + axis] = one * a + two * b
        frame[6 + axis] = one * b - two * a
    _turn_edges(floats(long_at(data + AT.velocity) + 8 * row, 4), 0, 1, one, two)
    _turn_edges(floats(long_at(data + AT.reference) + 8 * row, 4), 0, 1, one, two)
    if sparse > 0.0:
        first = integers(long_at(data + AT.rowadr), row + 1)[row]
        width = integers(long_at(data + AT.rownnz), row + 1)[row]
    else:
        width = long_at(model + AT.model_nv)
        first = row * width
    jacobian = floats(long_at(data + AT.jacobian) + 8 * first, 4 * width)
    for column in range(width):
        _turn_edges(jacobian, column, width, one, two)


@part
def _turn_edges(array: Floats, first: int, width: int, one: float, two: float) -> None:
    """Turn the numbers of four edges, n ± t1 and n ± t2, that are so far apart in an array."""
    second, third, fourth = first + width, first + 2 * width, first + 3 * width
    normal = 0.5 * (array[first] + array[second])
    a = 0.5 * (array[first] - array[second])
    b = 0.5 * (array[third] - array[fourth])
    array[first], array[second] = normal + (one * a + two * b), normal - (one * a + two * b)
    array[third], array[fourth] = normal + (one * b - two * a), normal - (one * b - two * a)


@part
def _last(model: int, data: int, row: int, sparse: float) -> float:
    """The acceleration of the last step along a row of the Jacobian."""
    width = long_at(model + AT.model_nv)
    before = floats(long_at(data + AT.warmstart), width)
    found = 0.0
    if sparse > 0.0:
        first = integers(long_at(data + AT.rowadr), row + 1)[row]
        count = integers(long_at(data + AT.rownnz), row + 1)[row]
        columns = integers(long_at(data + AT.colind) + 4 * first, count)
        jacobian = floats(long_at(data + AT.jacobian) + 8 * first, count)
        for place in range(count):
            found += jacobian[place] * before[columns[place]]
    else:
        jacobian = floats(long_at(data + AT.jacobian) + 8 * row * width, width)
        for place in range(width):
            found += jacobian[place] * before[place]
    return found
