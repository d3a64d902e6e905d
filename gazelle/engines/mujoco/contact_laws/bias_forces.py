"""Coriolis, centrifugal and gyroscopic forces of joints, at the middle of MuJoCo's step.

Semi-implicit Euler takes them at the velocity v that a step begins with. They are quadratic in v
and do no work at the v they belong to, so that taken too early they add to the energy of what
turns: by exp(h w² t / 2) at steps of h. Taken at the velocity of the middle, v + h a / 2 with
M a = f - c(v + h a / 2), they do not (the implicit midpoint rule). A few rounds find it; forces
of contacts and constraints, which are not known yet, are left out of a.
"""

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.gazelle.engines.mujoco.contact_laws.law_data_indices import (
    BIAS_HEAD,
    COM_VEL,
    COUNT,
    HINGES,
    RNE,
    SOLVE_M,
)
from cython.cimports.gazelle.engines.mujoco.contact_laws.struct_offsets import AT
from cython.cimports.gazelle.native.memory import call_five, call_four, call_two, floats, word

# What turns so slowly gains too little energy to matter: h w² [rad²/s]. A free body turns on
# about one axis for ever, so that there the product of two velocities counts.
_SLOW = cython.declare(cython.double, 1e-4)

# What turns further in a step is noticeably slow to precess [rad]: by one in a hundred.
MOST_A_STEP = 0.25

_ROUNDS = cython.declare(cython.int, 3)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def take_bias_midway(
    model: cython.size_t, data: cython.size_t, numbers: cython.size_t, too_fast: cython.size_t
) -> cython.bint:
    """Set the step to use the forces of its middle, where something turns fast enough.

    Args:
        model: Address of the ``mjModel``.
        data: Address of the ``mjData``.
        numbers: Address of the law's numbers, which the degrees of freedom to look at follow.
        too_fast: Address of a number that becomes one where something turns too far in a step.

    Returns:
        Whether it does.
    """
    own = floats(numbers)
    count: cython.int = cython.cast(cython.int, own[COUNT])
    watched = floats(numbers + 8 * BIAS_HEAD)
    nv: cython.Py_ssize_t = word(model + AT.model_nv)
    velocity = floats(word(data + AT.qvel))
    step = floats(model + AT.model_timestep)[0]
    first: cython.double = 0.0
    second: cython.double = 0.0
    for place in range(count):
        rate: cython.double = abs(velocity[cython.cast(cython.int, watched[place])])
        second = max(second, min(first, rate))
        first = max(first, rate)
        if place < own[HINGES]:
            second = max(second, rate)
    if not first * second * step > _SLOW:
        return False
    if first * step > MOST_A_STEP:
        floats(too_fast)[0] = 1.0
    # What comes later in the step fills these again.
    kept = floats(word(data + AT.constraint))
    force = floats(word(data + AT.smooth))
    gained = floats(word(data + AT.acceleration))
    bias = floats(word(data + AT.bias))
    passive = floats(word(data + AT.passive))
    applied = floats(word(data + AT.applied))
    for dof in range(nv):
        kept[dof] = velocity[dof]
    for _ in range(_ROUNDS):
        for dof in range(nv):
            force[dof] = passive[dof] + applied[dof] - bias[dof]
        call_five(
            cython.cast(cython.size_t, own[SOLVE_M]),
            model,
            data,
            word(data + AT.acceleration),
            word(data + AT.smooth),
            1,
        )
        for dof in range(nv):
            velocity[dof] = kept[dof] + 0.5 * step * gained[dof]
        call_two(cython.cast(cython.size_t, own[COM_VEL]), model, data)
        call_four(cython.cast(cython.size_t, own[RNE]), model, data, 0, word(data + AT.bias))
    for dof in range(nv):
        velocity[dof] = kept[dof]
    call_two(cython.cast(cython.size_t, own[COM_VEL]), model, data)
    return True
