"""The wanted velocities of motors, within MuJoCo's step.

A motor is a row of dry friction: MuJoCo looks for the acceleration a with a = r - R f, where
the effort f is at most the motor's, R is small and r is wanted. For friction r is -v / h, which
stops within a step of h; for a motor at v that is to have w it is (w - v) / h.

R f is what such a motor would be slower by. It is given back in the next step: with
r = (w - v) / h + g the velocity becomes v' = w + h (g - R f), so (w - v') / h + g is R f, and that
is the new g. Where the effort does not suffice it is R times the largest effort.
"""

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.gazelle.engines.mujoco.contact_laws.struct_offsets import AT
from cython.cimports.gazelle.native.memory import floats, integers, word

_FRICTION_OF_TENDON = cython.declare(cython.int, 2)  # mjCNSTR_FRICTION_TENDON


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def drive_motors(model: cython.size_t, data: cython.size_t, count: cython.int) -> cython.void:
    """Set motors to hold their velocities rather than rest.

    Args:
        model: Address of the ``mjModel``.
        data: Address of the ``mjData``.
        count: Number of motors; the model's tendons are theirs.
    """
    step = floats(model + AT.model_timestep)[0]
    wanted = floats(word(data + AT.userdata))
    first = integers(data + AT.ne)[0]
    last = first + integers(data + AT.nf)[0]
    kinds = integers(word(data + AT.kind))
    owners = integers(word(data + AT.owner))
    velocity = floats(word(data + AT.velocity))
    reference = floats(word(data + AT.reference))
    softness = floats(word(data + AT.softness))
    effort = floats(word(data + AT.frictionloss))
    for row in range(first, last):
        if kinds[row] == _FRICTION_OF_TENDON:
            motor = owners[row]
            rate = (wanted[motor] - velocity[row]) / step
            most = softness[row] * effort[row]
            given = min(max(wanted[count + motor] + rate, -most), most)
            wanted[count + motor] = given
            reference[row] = rate + given
