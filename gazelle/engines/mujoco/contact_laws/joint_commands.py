"""Systems that act within MuJoCo's step, and efforts of joints that are too fast already.

Compiled systems that need no more of MuJoCo than it can show in the middle of a step are updated here,
so that many steps are made without Python between. ``Hooks`` is where they are.

What would speed up a joint beyond its velocity limit does not act (``effort_limits``). It is kept until
the next step, as it acts again when the joint is slow.
"""

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.gazelle.engines.mujoco.contact_laws.struct_offsets import AT
from cython.cimports.gazelle.native.acting import (
    ACTS,
    ADDRESS,
    AHEAD,
    BETWEEN,
    OF_JOINTS,
    ROWS,
    WIDTH,
)
from cython.cimports.gazelle.native.due_times import next_due
from cython.cimports.gazelle.native.joint_system import JointSystem, copy
from cython.cimports.gazelle.native.memory import floats, longs, word
from cython.cimports.gazelle.native.system import System

from gazelle.native.loop import KNOWN


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def take_commands(
    data: cython.size_t, hooks: cython.size_t, world: cython.Py_ssize_t
) -> cython.void:
    """Update systems of a world, and hold back what is too fast.

    Args:
        data: Address of the ``mjData``.
        hooks: Address of ``Hooks``.
        world: Index of the world.
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
    update_systems(data, hook, world, time)
    if hook[8] >= 0 and not are_fast(hook[4], hook[8], applied, velocity, speeds):
        return
    for index in range(hook[4]):
        effort = applied[dofs[index]]
        if effort * velocity[dofs[index]] > 0.0 and abs(velocity[dofs[index]]) > speeds[index]:
            kept[index], applied[dofs[index]] = effort, 0.0


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def update_systems(
    data: cython.size_t,
    hook: cython.pointer[cython.longlong],
    world: cython.Py_ssize_t,
    time: cython.longlong,
) -> cython.void:
    """Update the systems that are due in a step of a world.

    Args:
        data: Address of the ``mjData``.
        hook: Numbers of ``Hooks``.
        world: Index of the world.
        time: At the beginning of the step [ns].
    """
    table = longs(cython.cast(cython.size_t, hook[1]))
    rates = floats(cython.cast(cython.size_t, hook[9]))
    due = longs(cython.cast(cython.size_t, hook[10]))
    end: cython.longlong = longs(cython.cast(cython.size_t, hook[11]))[0]
    index: cython.Py_ssize_t
    for index in range(hook[0]):
        acts: cython.longlong = table[WIDTH * index + ACTS]
        when: cython.longlong = time + hook[2] if acts == AHEAD else time
        if acts == BETWEEN or when >= end or not is_due(due[index], rates[index], when, hook[2]):
            continue
        address: cython.longlong = table[WIDTH * index + ADDRESS]
        rows: cython.longlong = table[WIDTH * index + ROWS]
        if acts == OF_JOINTS:
            exchange(data, address, world, when)
        else:
            update_one(data, hook, acts, address, world, rows, when)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def is_due(
    due: cython.longlong, rate: cython.double, time: cython.longlong, step: cython.longlong
) -> cython.bint:
    """Return whether a system is due in a step, of several that are made at once.

    Args:
        due: Time of the first update in these steps, or after [ns].
        rate: Of its updates [Hz]; 0 for every step.
        time: At which the step begins [ns].
        step: Duration of a step [ns].
    """
    if due > time:
        return False
    return rate <= 0.0 or due > time - step or next_due(time - step, rate) <= time


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def exchange(
    data: cython.size_t,
    address: cython.longlong,
    world: cython.Py_ssize_t,
    time: cython.longlong,
) -> cython.void:
    """Exchange measurements and commands with a system of joints."""
    qpos, qvel = floats(word(data + AT.qpos)), floats(word(data + AT.qvel))
    applied, user = floats(word(data + AT.applied)), floats(word(data + AT.userdata))
    if cython.compiled:
        place = cython.cast(cython.p_void, address)
        cython.cast(JointSystem, place).exchange(world, qpos, qvel, applied, user, time)
    else:
        KNOWN[int(address)].exchange(world, qpos, qvel, applied, user, time)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def update_one(
    data: cython.size_t,
    hook: cython.pointer[cython.longlong],
    acts: cython.longlong,
    address: cython.longlong,
    world: cython.Py_ssize_t,
    rows: cython.longlong,
    time: cython.longlong,
) -> cython.void:
    """Update a world's rows of a system that knows arrays of the state; MuJoCo steps on a copy of it."""
    row: cython.Py_ssize_t = hook[12] * world
    targets = floats(cython.cast(cython.size_t, hook[13] + row))
    user = floats(word(data + AT.userdata))
    if acts != AHEAD:
        copy(hook[14], user, targets)  # systems of joints may have written
    if cython.compiled:
        place = cython.cast(cython.p_void, address)
        cython.cast(System, place).update(world * rows, (world + 1) * rows, time)
    else:
        KNOWN[int(address)].update(world * rows, (world + 1) * rows, time)
    if acts != AHEAD:
        copy(hook[14], targets, user)
        return
    positions = floats(cython.cast(cython.size_t, hook[15] + row))
    quaternions = floats(cython.cast(cython.size_t, hook[16] + row))
    copy(3 * hook[17], positions, floats(word(data + AT.mocap_pos)))
    copy(4 * hook[17], quaternions, floats(word(data + AT.mocap_quat)))


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
