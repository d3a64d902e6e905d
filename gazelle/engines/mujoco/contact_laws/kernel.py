"""Laws of contacts and of tumbling that MuJoCo has no words for, within its step.

MuJoCo calls ``apply`` when it knows the contacts, their velocities and the acceleration that
each is to have, and before it solves for the forces. See ``docs/explanation/physics.md`` for the laws.
"""

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.gazelle.engines.mujoco.contact_laws.bias_forces import (
    MOST_A_STEP,
    take_bias_midway,
)
from cython.cimports.gazelle.engines.mujoco.contact_laws.contact_data import Touch
from cython.cimports.gazelle.engines.mujoco.contact_laws.contact_lookup import (
    begin_contact,
    begin_step,
)
from cython.cimports.gazelle.engines.mujoco.contact_laws.free_fall import fall
from cython.cimports.gazelle.engines.mujoco.contact_laws.joint_commands import take_commands
from cython.cimports.gazelle.engines.mujoco.contact_laws.law_data_indices import (
    BY_THE_NORMAL,
    GEOM_NUMBERS,
    HEAD,
    ITS_OWN,
    MARK,
    NO_DIRECTION,
    WORLD,
)
from cython.cimports.gazelle.engines.mujoco.contact_laws.penetration_velocity import leave_slowly
from cython.cimports.gazelle.engines.mujoco.contact_laws.rolling_contacts import hold_loosely
from cython.cimports.gazelle.engines.mujoco.contact_laws.sliding_friction import stay_down
from cython.cimports.gazelle.engines.mujoco.contact_laws.struct_offsets import AT
from cython.cimports.gazelle.engines.mujoco.contact_laws.velocity_motors import drive_motors
from cython.cimports.gazelle.engines.mujoco.contact_laws.wheel_contacts import stand_in_the_middle
from cython.cimports.gazelle.native.memory import floats, integers, word
from cython.cimports.libc.math import isfinite, sqrt

# An impact velocity that gravity builds up within this number of steps does not bounce.
_STEPS_TO_REST = cython.declare(cython.double, 2.0)

# MuJoCo's share of a bouncing contact's force.
_FULL = cython.declare(cython.double, 0.9999)

# Share of the way to a contact seen ahead that MuJoCo wants to make in a step.
_SPECULATIVE_SHARE = cython.declare(cython.double, 0.98)

# An acceleration that needs no force [m/s²].
_NOT_YET = cython.declare(cython.double, -1e9)

# Larger than any friction.
_FAR_MORE = cython.declare(cython.double, 1e300)

# What turns so slowly gains no energy that could be seen: h w² [rad²/s].
_AT_REST = cython.declare(cython.double, 1e-8)

_ROUNDS = cython.declare(cython.int, 8)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def apply(model: cython.size_t, data: cython.size_t) -> cython.void:
    """Apply the contact laws to what MuJoCo is about to solve; other models stay unchanged.

    Args:
        model: Address of the ``mjModel``.
        data: Address of the ``mjData``.
    """
    if word(model + AT.model_nnumeric) == 0:
        return
    head = floats(word(model + AT.model_numeric))
    if head[0] != MARK:
        return
    if head[9] > 0.0:
        take_commands(
            data,
            cython.cast(cython.size_t, head[9]),
            cython.cast(cython.Py_ssize_t, head[WORLD]),
        )
    midway: cython.bint = False
    if head[7] > 0.0:
        place = word(model + AT.model_numeric) + 8 * (
            HEAD + 2 * cython.cast(cython.size_t, head[2])
        )
        midway = take_bias_midway(model, data, place, cython.cast(cython.size_t, head[8]))
    if head[2] > 0.0 and not midway:
        _keep_turning(
            model, data, cython.cast(cython.int, head[2]), cython.cast(cython.size_t, head[8])
        )
    if head[3] > 0.0:
        drive_motors(model, data, cython.cast(cython.int, head[3]))
    touch = cython.declare(Touch[1])
    begin_step(touch, model, data)
    contacts = word(data + AT.contact)
    for index in range(integers(data + AT.ncon)[0]):
        if begin_contact(touch, contacts + index * AT.contact_size):
            _correct(touch, head)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _correct(touch: cython.pointer[Touch], head: cython.p_double) -> cython.void:
    """Apply the laws to the rows of a contact."""
    if head[4] > 0.0:
        _direct(touch)
    if head[5] > 0.0:
        stand_in_the_middle(touch)
    if head[6] > 0.0:
        leave_slowly(touch)
    if floats(touch.contact + AT.contact_solreffriction)[1] < 0.0:
        _bounce(touch)
    if head[6] > 0.0:
        hold_loosely(touch)
        stay_down(touch)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _bounce(touch: cython.pointer[Touch]) -> cython.void:
    """Set the bounce of two bodies in the step of the impact, to reach e² of the height."""
    step, reference, contact = touch.step, touch.reference, touch.contact
    pull = -fall(touch, 0)
    speed, late = -touch.velocity[0], 0.5 * pull * step
    if speed <= _STEPS_TO_REST * abs(pull) * step or speed <= 0.0:
        return
    e = -floats(contact + AT.contact_solref)[1] * step / _FULL - 1.0
    height = floats(contact + AT.contact_dist)[0] - floats(contact + AT.contact_margin)[0]
    if height > 0.0:
        # A contact seen ahead: MuJoCo says how high it is by the speed that it wants.
        height = (speed - reference[0] * step) * step / _SPECULATIVE_SHARE
    fallen = -2.0 * pull * min(max(height, -speed * step), speed * step)
    parting = e * e * ((speed + late) * (speed + late) - fallen) + fallen
    if parting > late * late:
        reference[0] = (sqrt(parting) - late + speed) / step
    elif height > 0.0:
        reference[0] = _NOT_YET


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _direct(touch: cython.pointer[Touch]) -> cython.void:
    """Turn the two friction directions of a contact to those of its surfaces."""
    if touch.dim < 3 or not touch.cone:
        return
    frame = touch.frame
    wanted = cython.declare(cython.double[3])
    wanted[0] = wanted[1] = wanted[2] = 0.0
    _first_direction(touch, wanted)
    one, two = 0.0, 0.0
    for axis in range(3):
        one += wanted[axis] * frame[3 + axis]
        two += wanted[axis] * frame[6 + axis]
    size = sqrt(one * one + two * two)
    if size < 1e-3:
        return
    one, two = one / size, two / size
    for axis in range(3):
        _turn(frame, 3 + axis, 6 + axis, one, two)
    _turn(touch.velocity, 1, 2, one, two)
    _turn(touch.reference, 1, 2, one, two)
    for column in range(touch.width):
        _turn(touch.jacobian, touch.width + column, 2 * touch.width + column, one, two)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _turn(
    array: cython.p_double,
    first: cython.int,
    second: cython.int,
    one: cython.double,
    two: cython.double,
) -> cython.void:
    a, b = array[first], array[second]
    array[first] = one * a + two * b
    array[second] = one * b - two * a


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _first_direction(touch: cython.pointer[Touch], found: cython.p_double) -> cython.void:
    """Compute ODE's first direction of a contact in the world; zeros where it does not matter."""
    chosen, least, kind = -1, _FAR_MORE, NO_DIRECTION
    for side in range(2):
        geom = touch.geoms[side]
        if geom < 0:
            continue
        own = floats(touch.users + 8 * GEOM_NUMBERS * geom)
        if own[0] == ITS_OWN and (kind != ITS_OWN or own[4] < least):
            chosen, least, kind = geom, own[4], ITS_OWN
        elif own[0] == BY_THE_NORMAL and kind == NO_DIRECTION:
            kind = BY_THE_NORMAL
    if kind == ITS_OWN:
        own = floats(touch.users + 8 * GEOM_NUMBERS * chosen)
        turn = floats(word(touch.data + AT.geom_xmat) + 72 * chosen)
        for axis in range(3):
            found[axis] = (
                turn[3 * axis] * own[1] + turn[3 * axis + 1] * own[2] + turn[3 * axis + 2] * own[3]
            )
    elif kind == BY_THE_NORMAL:
        normal = touch.frame
        if abs(normal[2]) > sqrt(0.5):
            found[1], found[2] = -normal[2], normal[1]
        else:
            found[0], found[1] = -normal[1], normal[0]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _keep_turning(
    model: cython.size_t, data: cython.size_t, count: cython.int, too_fast: cython.size_t
) -> cython.void:
    """Set the gyroscopic torque of free bodies to that of the middle of the step."""
    step = floats(model + AT.model_timestep)[0]
    numbers = floats(word(model + AT.model_numeric))
    spin = cython.declare(cython.double[3])
    middle = cython.declare(cython.double[3])
    rate = cython.declare(cython.double[3])
    wanted = cython.declare(cython.double[3])
    for place in range(count):
        body = cython.cast(cython.int, numbers[HEAD + 2 * place])
        dof = cython.cast(cython.int, numbers[HEAD + 2 * place + 1])
        velocity = floats(word(data + AT.qvel) + 8 * (dof + 3))
        fast = velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2]
        if fast * step < _AT_REST:
            continue
        if fast * step * step > MOST_A_STEP * MOST_A_STEP:
            floats(too_fast)[0] = 1.0
        moments = floats(word(model + AT.model_inertia) + 24 * body)
        axes = floats(word(model + AT.model_iquat) + 32 * body)
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
        torque = floats(word(data + AT.passive) + 8 * (dof + 3))
        if isfinite(rate[0] + rate[1] + rate[2]):
            for axis in range(3):
                torque[axis] += rate[axis]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _gyration(spin: cython.p_double, moments: cython.p_double, out: cython.p_double) -> cython.void:
    """Compute the gyroscopic torque, -w x I w, along principal axes."""
    out[0] = (moments[1] - moments[2]) * spin[1] * spin[2]
    out[1] = (moments[2] - moments[0]) * spin[2] * spin[0]
    out[2] = (moments[0] - moments[1]) * spin[0] * spin[1]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _rotate(
    turn: cython.p_double, vector: cython.p_double, sense: cython.double, out: cython.p_double
) -> cython.void:
    """Rotate by a quaternion (w, x, y, z), or back."""
    w, x, y, z = turn[0], sense * turn[1], sense * turn[2], sense * turn[3]
    a = 2.0 * (y * vector[2] - z * vector[1])
    b = 2.0 * (z * vector[0] - x * vector[2])
    c = 2.0 * (x * vector[1] - y * vector[0])
    out[0] = vector[0] + w * a + y * c - z * b
    out[1] = vector[1] + w * b + z * a - x * c
    out[2] = vector[2] + w * c + x * b - y * a


def address() -> int:
    """Return the address of ``apply``, for MuJoCo; 0 where Python runs it."""
    if cython.compiled:
        return int(cython.cast(cython.size_t, cython.cast(cython.p_void, apply)))
    return 0
