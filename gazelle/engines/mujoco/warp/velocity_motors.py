"""Motors that hold a velocity: ``contact_laws.velocity_motors`` on the device; see its source there."""

import warp as wp

wp.set_module_options({"enable_backward": False})

FRICTION_OF_TENDON = wp.constant(2)  # mjCNSTR_FRICTION_TENDON


@wp.kernel
def drive_motors(
    count: int,
    timestep: wp.array[float],
    used: wp.array[int],
    kind: wp.array2d[int],
    owner: wp.array2d[int],
    velocity: wp.array2d[float],
    stiffness: wp.array2d[float],
    effort: wp.array2d[float],
    target: wp.array2d[float],
    reference: wp.array2d[float],
) -> None:
    """Set motors to hold their velocities rather than rest; the model's tendons are theirs."""
    world, row = wp.tid()
    if row >= used[world] or kind[world, row] != FRICTION_OF_TENDON:
        return
    motor = owner[world, row]
    step = timestep[world % timestep.shape[0]]
    rate = (target[world, motor] - velocity[world, row]) / step
    most = effort[world, row] / stiffness[world, row]
    given = wp.clamp(target[world, count + motor] + rate, -most, most)
    target[world, count + motor] = given
    reference[world, row] = rate + given
