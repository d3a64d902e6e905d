"""Efforts of joints within MuJoCo's step: what controllers command, and what is too fast already.

Controllers that are native code (``gazelle.native.joint_system``) are told of joints, and command
them, here, so that many steps are made without Python between. ``Hooks`` is where they are.

What would speed up a joint beyond its velocity limit does not act (``effort_limits``). It is kept until
the next step, as it acts again when the joint is slow.
"""

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.gazelle.engines.mujoco.contact_laws.struct_offsets import AT
from cython.cimports.gazelle.native.joint_system import bring_systems
from cython.cimports.gazelle.native.memory import floats, longs, word


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def take_commands(
    data: cython.size_t, hooks: cython.size_t, world: cython.Py_ssize_t
) -> cython.void:
    """Update controllers of a world, and hold back what is too fast.

    Args:
        data: Address of the ``mjData``.
        hooks: Address of ``Hooks``.
        world: Which.
    """
    hook = longs(hooks)
    if hook[0] == 0:
        return
    velocity = floats(word(data + AT.qvel))
    applied = floats(word(data + AT.applied))
    dofs = longs(cython.cast(cython.size_t, hook[5]))
    speeds = floats(cython.cast(cython.size_t, hook[6]))
    kept = floats(cython.cast(cython.size_t, hook[7] + 8 * hook[4] * world))
    for index in range(hook[4]):
        if kept[index] != 0.0:
            applied[dofs[index]], kept[index] = kept[index], 0.0
    times = longs(cython.cast(cython.size_t, hook[3]))
    time: cython.longlong = times[world]
    times[world] = time + hook[2]
    bring_systems(
        longs(cython.cast(cython.size_t, hook[1])),
        hook[0],
        world,
        floats(word(data + AT.qpos)),
        velocity,
        applied,
        floats(word(data + AT.userdata)),
        time,
    )
    if hook[8] >= 0 and not are_fast(hook[4], hook[8], applied, velocity, speeds):
        return
    for index in range(hook[4]):
        effort = applied[dofs[index]]
        if effort * velocity[dofs[index]] > 0.0 and abs(velocity[dofs[index]]) > speeds[index]:
            kept[index], applied[dofs[index]] = effort, 0.0


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def are_fast(
    count: cython.longlong,
    first: cython.longlong,
    applied: cython.p_double,
    velocity: cython.p_double,
    speeds: cython.p_double,
) -> cython.bint:
    """Return whether an effort accelerates a velocity that is too fast, several at a time."""
    found: cython.Py_ssize_t = 0
    index: cython.Py_ssize_t
    for index in range(count):
        rate: cython.double = velocity[first + index]
        onward: cython.bint = applied[first + index] * rate > 0.0
        found += 1 if onward and abs(rate) > speeds[index] else 0
    return found > 0
