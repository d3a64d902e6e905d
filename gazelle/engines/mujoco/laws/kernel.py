"""Laws of contacts and of tumbling that MuJoCo has no words for, within its step.

MuJoCo calls ``apply`` when it knows the contacts, their velocities and the acceleration that
each is to have, and before it solves for the forces. See ``docs/physics.md`` for the laws.
"""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from gazelle.engines.mujoco.laws.bias import MOST_A_STEP, take_bias_midway
from gazelle.engines.mujoco.laws.exits import leave_slowly
from gazelle.engines.mujoco.laws.layouts import offsets
from gazelle.engines.mujoco.laws.motors import drive_motors
from gazelle.engines.mujoco.laws.numbers import (
    BY_THE_NORMAL,
    GEOM_NUMBERS,
    HEAD,
    ITS_OWN,
    MARK,
    NO_DIRECTION,
)
from gazelle.engines.mujoco.laws.rolling import hold_loosely
from gazelle.engines.mujoco.laws.sliding import stay_down
from gazelle.engines.mujoco.laws.treads import stand_in_the_middle
from gazelle.engines.native import floats, integers, long_at, part, whole

Floats: TypeAlias = NDArray[np.float64]

AT = offsets()

# An impact that gravity makes in so many steps is no bounce but rest.
_STEPS_TO_REST = 2.0

# MuJoCo's share of a bouncing contact's force.
_FULL = 0.9999

# Share of the way to a contact seen ahead that MuJoCo wants to make in a step.
_SPECULATIVE_SHARE = 0.98

# An acceleration that needs no force [m/s²].
_NOT_YET = -1e9

_FREE = 0  # mjJNT_FREE
_ELLIPTIC = 1  # mjCONE_ELLIPTIC

# What turns so slowly gains no energy that could be seen: h w² [rad²/s].
_AT_REST = 1e-8

_ROUNDS = 8


@whole
def apply(model: int, data: int) -> None:
    """Change what MuJoCo is about to solve for; of other models, nothing.

    Args:
        model: Address of the ``mjModel``.
        data: Address of the ``mjData``.
    """
    if long_at(model + AT.model_nnumeric) == 0:
        return
    head = floats(long_at(model + AT.model_numeric), HEAD)
    if head[0] != MARK:
        return
    midway = False
    if head[7] > 0.0:
        place = long_at(model + AT.model_numeric) + 8 * (HEAD + 2 * int(head[2]))
        midway = take_bias_midway(model, data, place, int(head[8]))
    if head[2] > 0.0 and not midway:
        _keep_turning(model, data, int(head[2]), int(head[8]))
    if head[3] > 0.0:
        drive_motors(model, data, int(head[3]))
    contacts = long_at(data + AT.contact)
    for index in range(integers(data + AT.ncon, 1)[0]):
        contact = contacts + index * AT.contact_size
        row = integers(contact + AT.contact_address, 1)[0]
        if row >= 0:
            _correct(model, data, contact, row)


@part
def _correct(model: int, data: int, contact: int, row: int) -> None:
    """Change the rows of a contact."""
    head = floats(long_at(model + AT.model_numeric), HEAD)
    if head[4] > 0.0:
        _direct(model, data, contact, row, head[1])
    if head[5] > 0.0:
        stand_in_the_middle(model, data, contact, row, head[1])
    if head[6] > 0.0:
        leave_slowly(model, data, contact, row)
    if floats(contact + AT.contact_solreffriction, 2)[1] < 0.0:
        _bounce(model, data, contact, row)
    if head[6] > 0.0:
        hold_loosely(model, data, contact, row)
        stay_down(model, data, contact, row, head[1])


@part
def _bounce(model: int, data: int, contact: int, row: int) -> None:
    """Let two bodies part so that e² of the height is reached, in the step of the impact."""
    step = floats(model + AT.model_timestep, 1)[0]
    velocity = floats(long_at(data + AT.velocity), row + 1)
    pull = _pull(model, contact)
    speed, late = -velocity[row], 0.5 * pull * step
    if speed <= _STEPS_TO_REST * abs(pull) * step or speed <= 0.0:
        return
    e = -floats(contact + AT.contact_solref, 2)[1] * step / _FULL - 1.0
    reference = floats(long_at(data + AT.reference), row + 1)
    height = floats(contact + AT.contact_dist, 1)[0] - floats(contact + AT.contact_margin, 1)[0]
    if height > 0.0:
        # A contact seen ahead: MuJoCo says how high it is by the speed that it wants.
        height = (speed - reference[row] * step) * step / _SPECULATIVE_SHARE
    fallen = -2.0 * pull * min(max(height, -speed * step), speed * step)
    parting = e * e * ((speed + late) ** 2 - fallen) + fallen
    if parting > late * late:
        reference[row] = (math.sqrt(parting) - late + speed) / step
    elif height > 0.0:
        reference[row] = _NOT_YET


@part
def _pull(model: int, contact: int) -> float:
    """How much faster two bodies approach a second later if nothing holds them."""
    normal = floats(contact + AT.contact_frame, 3)
    geoms = integers(contact + AT.contact_geom, 2)
    gravity = floats(model + AT.model_gravity, 3)
    along = 0.0
    for side in range(2):
        geom = geoms[side]
        body = integers(long_at(model + AT.model_bodyid), geom + 1)[geom]
        root = integers(long_at(model + AT.model_rootid), body + 1)[body]
        if integers(long_at(model + AT.model_jntnum), root + 1)[root] == 0:
            continue
        joint = integers(long_at(model + AT.model_jntadr), root + 1)[root]
        if integers(long_at(model + AT.model_jnt_type), joint + 1)[joint] != _FREE:
            continue
        borne = floats(long_at(model + AT.model_gravcomp), body + 1)[body]
        sign = 1.0 if side == 0 else -1.0
        for axis in range(3):
            along += sign * (1.0 - borne) * gravity[axis] * normal[axis]
    return along


@part
def _direct(model: int, data: int, contact: int, row: int, sparse: float) -> None:
    """Turn the two directions in which a contact rubs to those that its surfaces have."""
    if integers(contact + AT.contact_dim, 1)[0] < 3:
        return
    if integers(model + AT.model_cone, 1)[0] != _ELLIPTIC:
        return
    frame = floats(contact + AT.contact_frame, 9)
    wanted = np.zeros(3)
    _first_direction(model, data, contact, wanted)
    one, two = 0.0, 0.0
    for axis in range(3):
        one += wanted[axis] * frame[3 + axis]
        two += wanted[axis] * frame[6 + axis]
    size = math.sqrt(one * one + two * two)
    if size < 1e-3:
        return
    one, two = one / size, two / size
    for axis in range(3):
        _turn(frame, 3 + axis, 6 + axis, one, two)
    _turn(floats(long_at(data + AT.velocity), row + 3), row + 1, row + 2, one, two)
    _turn(floats(long_at(data + AT.reference), row + 3), row + 1, row + 2, one, two)
    if sparse > 0.0:
        addresses = integers(long_at(data + AT.rowadr), row + 3)
        first, second = addresses[row + 1], addresses[row + 2]
        width = integers(long_at(data + AT.rownnz), row + 3)[row + 1]
    else:
        width = long_at(model + AT.model_nv)
        first, second = (row + 1) * width, (row + 2) * width
    jacobian = floats(long_at(data + AT.jacobian), second + width)
    for column in range(width):
        _turn(jacobian, first + column, second + column, one, two)


@part
def _turn(array: Floats, first: int, second: int, one: float, two: float) -> None:
    a, b = array[first], array[second]
    array[first] = one * a + two * b
    array[second] = one * b - two * a


@part
def _first_direction(model: int, data: int, contact: int, found: Floats) -> None:
    """ODE's first direction of a contact in the world; zeros remain where it does not matter."""
    geoms = integers(contact + AT.contact_geom, 2)
    chosen, least, kind = -1, math.inf, NO_DIRECTION
    for side in range(2):
        geom = geoms[side]
        if geom < 0:
            continue
        start = long_at(model + AT.model_geom_user) + 8 * GEOM_NUMBERS * geom
        own = floats(start, GEOM_NUMBERS)
        if own[0] == ITS_OWN and (kind != ITS_OWN or own[4] < least):
            chosen, least, kind = geom, own[4], ITS_OWN
        elif own[0] == BY_THE_NORMAL and kind == NO_DIRECTION:
            kind = BY_THE_NORMAL
    if kind == ITS_OWN:
        start = long_at(model + AT.model_geom_user) + 8 * GEOM_NUMBERS * chosen
        own = floats(start, GEOM_NUMBERS)
        turn = floats(long_at(data + AT.geom_xmat) + 72 * chosen, 9)
        for axis in range(3):
            found[axis] = (
                turn[3 * axis] * own[1] + turn[3 * axis + 1] * own[2] + turn[3 * axis + 2] * own[3]
            )
    elif kind == BY_THE_NORMAL:
        normal = floats(contact + AT.contact_frame, 3)
        if abs(normal[2]) > math.sqrt(0.5):
            found[1], found[2] = -normal[2], normal[1]
        else:
            found[0], found[1] = -normal[1], normal[0]


@part
def _keep_turning(model: int, data: int, count: int, told: int) -> None:
    """Take the gyroscopic torque of loose bodies at the middle of the step, not its beginning."""
    step = floats(model + AT.model_timestep, 1)[0]
    numbers = floats(long_at(model + AT.model_numeric), HEAD + 2 * count)
    spin, middle, rate, wanted = np.zeros(3), np.zeros(3), np.zeros(3), np.zeros(3)
    for place in range(count):
        body, dof = int(numbers[HEAD + 2 * place]), int(numbers[HEAD + 2 * place + 1])
        velocity = floats(long_at(data + AT.qvel) + 8 * (dof + 3), 3)
        fast = velocity[0] ** 2 + velocity[1] ** 2 + velocity[2] ** 2
        if fast * step < _AT_REST:
            continue
        if fast * step * step > MOST_A_STEP * MOST_A_STEP:
            floats(told, 1)[0] = 1.0
        moments = floats(long_at(model + AT.model_inertia) + 24 * body, 3)
        axes = floats(long_at(model + AT.model_iquat) + 32 * body, 4)
        _rotate(axes, velocity, -1.0, spin)
        for axis in range(3):
            middle[axis] = spin[axis]
        for _ in range(_ROUNDS):
            _gyration(middle, moments, rate)
            for axis in range(3):
                middle[axis] = spin[axis] + 0.5 * step * rate[axis] / moments[axis]
        _gyration(middle, moments, rate)
        _gyration(spin, moments, wanted)
        for axis in range(3):
            wanted[axis] = rate[axis] - wanted[axis]
        _rotate(axes, wanted, 1.0, rate)
        torque = floats(long_at(data + AT.passive) + 8 * (dof + 3), 3)
        if math.isfinite(rate[0] + rate[1] + rate[2]):
            for axis in range(3):
                torque[axis] += rate[axis]


@part
def _gyration(spin: Floats, moments: Floats, out: Floats) -> None:
    """The gyroscopic torque, -w x I w, along principal axes."""
    out[0] = (moments[1] - moments[2]) * spin[1] * spin[2]
    out[1] = (moments[2] - moments[0]) * spin[2] * spin[0]
    out[2] = (moments[0] - moments[1]) * spin[0] * spin[1]


@part
def _rotate(turn: Floats, vector: Floats, sense: float, out: Floats) -> None:
    """Rotate by a quaternion (w, x, y, z), or back."""
    w, x, y, z = turn[0], sense * turn[1], sense * turn[2], sense * turn[3]
    a = 2.0 * (y * vector[2] - z * vector[1])
    b = 2.0 * (z * vector[0] - x * vector[2])
    c = 2.0 * (x * vector[1] - y * vector[0])
    out[0] = vector[0] + w * a + y * c - z * b
    out[1] = vector[1] + w * b + z * a - x * c
    out[2] = vector[2] + w * c + x * b - y * a
