"""Coriolis, centrifugal and gyroscopic forces of joints, at the middle of MuJoCo's step.

Semi-implicit Euler takes them at the velocity v that a step begins with. They are quadratic in v
and do no work at the v they belong to, so that taken too early they add to the energy of what
turns: by exp(h w² t / 2) at steps of h. Taken at the velocity of the middle, v + h a / 2 with
M a = f - c(v + h a / 2), they do not (the implicit midpoint rule). A few rounds find it; forces
of contacts and constraints, which are not known yet, are left out of a.
"""

from __future__ import annotations

from gazelle.engines.mujoco.laws.layouts import offsets
from gazelle.engines.mujoco.laws.numbers import BIAS_HEAD, COM_VEL, COUNT, HINGES, RNE, SOLVE_M
from gazelle.engines.native import call_c, floats, long_at, part

AT = offsets()

# What turns so slowly gains too little energy to matter: h w² [rad²/s]. A free body turns on
# about one axis for ever, so that there the product of two velocities counts.
_SLOW = 1e-4

# What turns further in a step is noticeably slow to precess [rad]: by one in a hundred.
MOST_A_STEP = 0.25

_ROUNDS = 3


@part
def take_bias_midway(model: int, data: int, numbers: int, told: int) -> bool:
    """Let the step use the forces of its middle, where something turns fast enough.

    Args:
        model: Address of the ``mjModel``.
        data: Address of the ``mjData``.
        numbers: Address of the law's numbers, which the degrees of freedom to look at follow.
        told: Address of a number that becomes one where something turns too far in a step.

    Returns:
        Whether it does.
    """
    own = floats(numbers, BIAS_HEAD)
    count = int(own[COUNT])
    watched = floats(numbers + 8 * BIAS_HEAD, count)
    nv = long_at(model + AT.model_nv)
    velocity = floats(long_at(data + AT.qvel), nv)
    step = floats(model + AT.model_timestep, 1)[0]
    first, second = 0.0, 0.0
    for place in range(count):
        rate = abs(velocity[int(watched[place])])
        second = max(second, min(first, rate))
        first = max(first, rate)
        if place < int(own[HINGES]):
            second = max(second, rate)
    if not first * second * step > _SLOW:
        return False
    if first * step > MOST_A_STEP:
        floats(told, 1)[0] = 1.0
    # What comes later in the step fills these anew.
    kept = floats(long_at(data + AT.constraint), nv)
    force = floats(long_at(data + AT.smooth), nv)
    gained = floats(long_at(data + AT.acceleration), nv)
    bias = floats(long_at(data + AT.bias), nv)
    passive = floats(long_at(data + AT.passive), nv)
    applied = floats(long_at(data + AT.applied), nv)
    for dof in range(nv):
        kept[dof] = velocity[dof]
    for _ in range(_ROUNDS):
        for dof in range(nv):
            force[dof] = passive[dof] + applied[dof] - bias[dof]
        call_c(
            int(own[SOLVE_M]),
            model,
            data,
            long_at(data + AT.acceleration),
            long_at(data + AT.smooth),
            1,
        )
        for dof in range(nv):
            velocity[dof] = kept[dof] + 0.5 * step * gained[dof]
        call_c(int(own[COM_VEL]), model, data)
        call_c(int(own[RNE]), model, data, 0, long_at(data + AT.bias))
    for dof in range(nv):
        velocity[dof] = kept[dof]
    call_c(int(own[COM_VEL]), model, data)
    return True
