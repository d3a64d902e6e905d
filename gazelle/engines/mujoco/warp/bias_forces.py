"""Forces of what turns, at the middle of a step: ``contact_laws.bias_forces`` and the tumbling of free bodies.

Their sources are documented there and in ``contact_laws.kernel``.
"""

import warp as wp

wp.set_module_options({"enable_backward": False})

# As in ``contact_laws.bias_forces``: h w² that is slow, and the most that something may turn in a step [rad].
SLOW = wp.constant(1.0e-4)
MOST_A_STEP = wp.constant(0.25)
AT_REST = wp.constant(1.0e-8)
TUMBLING_ROUNDS = wp.constant(8)


@wp.kernel
def find_swings(
    hinges: int,
    watched: wp.array[int],
    timestep: wp.array[float],
    qvel: wp.array2d[float],
    kept: wp.array2d[float],
    swings: wp.array[int],
    too_fast: wp.array[int],
) -> None:
    """Find the worlds in which something swings fast enough to matter, and keep all velocities."""
    world = wp.tid()
    step = timestep[world % timestep.shape[0]]
    for dof in range(qvel.shape[1]):
        kept[world, dof] = qvel[world, dof]
    first = float(0.0)
    second = float(0.0)
    for place in range(watched.shape[0]):
        rate = wp.abs(qvel[world, watched[place]])
        second = wp.max(second, wp.min(first, rate))
        first = wp.max(first, rate)
        if place < hinges:
            second = wp.max(second, rate)
    swings[world] = 0
    if first * second * step > SLOW:
        swings[world] = 1
        if first * step > MOST_A_STEP:
            too_fast[0] = 1


@wp.kernel
def sum_forces(
    passive: wp.array2d[float],
    applied: wp.array2d[float],
    bias: wp.array2d[float],
    force: wp.array2d[float],
) -> None:
    """Sum the forces on joints except contacts and constraints."""
    world, dof = wp.tid()
    force[world, dof] = passive[world, dof] + applied[world, dof] - bias[world, dof]


@wp.kernel
def go_half_way(
    timestep: wp.array[float],
    swings: wp.array[int],
    kept: wp.array2d[float],
    gained: wp.array2d[float],
    qvel: wp.array2d[float],
) -> None:
    """Compute the velocities of the middle of the step where something swings."""
    world, dof = wp.tid()
    if swings[world] != 0:
        step = timestep[world % timestep.shape[0]]
        qvel[world, dof] = kept[world, dof] + 0.5 * step * gained[world, dof]


@wp.kernel
def keep_turning(
    bodies: wp.array[wp.vec2i],
    timestep: wp.array[float],
    body_inertia: wp.array2d[wp.vec3],
    body_iquat: wp.array2d[wp.quat],
    swings: wp.array[int],
    qvel: wp.array2d[float],
    passive: wp.array2d[float],
    too_fast: wp.array[int],
) -> None:
    """Compute the gyroscopic torque of free bodies at the middle of the step."""
    world, place = wp.tid()
    body = bodies[place][0]
    dof = bodies[place][1] + 3
    step = timestep[world % timestep.shape[0]]
    velocity = wp.vec3(qvel[world, dof], qvel[world, dof + 1], qvel[world, dof + 2])
    fast = wp.dot(velocity, velocity)
    if swings[world] != 0 or fast * step < AT_REST:
        return
    if fast * step * step > MOST_A_STEP * MOST_A_STEP:
        too_fast[0] = 1
    moments = body_inertia[world % body_inertia.shape[0], body]
    wxyz = body_iquat[world % body_iquat.shape[0], body]
    axes = wp.quat(wxyz[1], wxyz[2], wxyz[3], wxyz[0])  # MuJoCo's order, made Warp's
    spin = wp.quat_rotate_inv(axes, velocity)
    middle = spin
    for _round in range(TUMBLING_ROUNDS):
        middle = spin + 0.5 * step * wp.cw_div(_gyration(middle, moments), moments)
    more = wp.quat_rotate(axes, _gyration(middle, moments) - _gyration(spin, moments))
    if wp.isfinite(more[0] + more[1] + more[2]):
        for axis in range(3):
            passive[world, dof + axis] = passive[world, dof + axis] + more[axis]


@wp.func
def _gyration(spin: wp.vec3, moments: wp.vec3) -> wp.vec3:
    """Return the gyroscopic torque, -w x I w, along principal axes."""
    return wp.vec3(
        (moments[1] - moments[2]) * spin[1] * spin[2],
        (moments[2] - moments[0]) * spin[2] * spin[0],
        (moments[0] - moments[1]) * spin[0] * spin[1],
    )
