"""The wanted velocities of motors, within MuJoCo's step.

A motor is a row of dry friction: MuJoCo looks for the acceleration a with a = r - R f, where
the effort f is at most the motor's, R is small and r is wanted. For friction r is -v / h, which
stops within a step of h; for a motor at v that is to have w it is (w - v) / h.

R f is what such a motor would be slower by. It is given back in the next step: with
r = (w - v) / h + g the velocity becomes v' = w + h (g - R f), so (w - v') / h + g is R f, and that
is the new g. Where the effort does not suffice it is R times the largest effort.
"""

from __future__ import annotations

from gazelle.engines.mujoco.laws.layouts import offsets
from gazelle.engines.native import floats, integers, long_at, part

AT = offsets()

_FRICTION_OF_TENDON = 2  # mjCNSTR_FRICTION_TENDON


@part
def drive_motors(model: int, data: int, count: int) -> None:
    """Let motors hold their velocities rather than stand still.

    Args:
        model: Address of the ``mjModel``.
        data: Address of the ``mjData``.
        count: How many motors there are; the model's tendons are theirs.
    """
    step = floats(model + AT.model_timestep, 1)[0]
    wanted = floats(long_at(data + AT.userdata), 2 * count)
    first = integers(data + AT.ne, 1)[0]
    last = first + integers(data + AT.nf, 1)[0]
    kinds = integers(long_at(data + AT.kind), last)
    owners = integers(long_at(data + AT.owner), last)
    velocity = floats(long_at(data + AT.velocity), last)
    reference = floats(long_at(data + AT.reference), last)
    softness = floats(long_at(data + AT.softness), last)
    effort = floats(long_at(data + AT.frictionloss), last)
    for row in range(first, last):
        if kinds[row] == _FRICTION_OF_TENDON:
            motor = owners[row]
            rate = (wanted[motor] - velocity[row]) / step
            most = softness[row] * effort[row]
            given = min(max(wanted[count + motor] + rate, -most), most)
            wanted[count + motor] = given
            reference[row] = rate + given
