"""A control step of a base with two wheels among bodies on scripted paths.

What is done is what ``libgazebo_ros_diff_drive.so`` and ``libgazelle_scripted_motion.so`` do
to the planar engine, update by update. Where nothing can be met within the control step, the
way between two updates is made as one arc, which is exact, and nothing is tested.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.engines.native import kernel, part, whole
from gazelle.engines.planar.columns import (
    BOUND,
    CENTRE_X,
    CENTRE_Y,
    COS,
    FIRST_PIECE,
    LAST_PIECE,
    SIN,
    YAW,
    X,
    Y,
    Z,
)
from gazelle.engines.planar.kernels_bump import statics_meet
from gazelle.engines.planar.kernels_grid import relink
from gazelle.engines.planar.kernels_motion import go
from gazelle.engines.planar.kernels_step import advance
from gazelle.envs.planar.tables import (
    LAW_BODY,
    LAW_HALF,
    LAW_RADIUS,
    LAW_RAMP,
    LAW_REACH,
    PATH_BODY,
    PATH_FIRST,
    PATH_LAST,
    PATH_LOOP,
    PATH_SPIN,
    PATH_START,
    Floats,
    Table,
    Worlds,
)

_DEADBAND = 0.01  # of the ramp, as in the drive plugin [m/s]


@part
def ramp(speeds: Floats, w: int, left: float, right: float, most: float) -> None:
    """One update of the wheels' speeds [m/s]; they change by ``most``, or at once if 0 or less."""
    a, b = left - speeds[w, 0], right - speeds[w, 1]
    if most >= 0.0 and abs(a) >= _DEADBAND and abs(b) >= _DEADBAND:
        speeds[w, 0] += min(max(a, -most), most)
        speeds[w, 1] += min(max(b, -most), most)
    else:
        speeds[w, 0], speeds[w, 1] = left, right


@part
def turn_to(pose: Floats, b: int, yaw: float) -> None:
    """Give a body a heading [rad]."""
    if abs(yaw) > math.pi:
        yaw -= 2.0 * math.pi * math.floor(yaw / (2.0 * math.pi) + 0.5)
    if yaw == pose[b, YAW]:
        return
    pose[b, YAW], pose[b, COS], pose[b, SIN] = yaw, math.cos(yaw), math.sin(yaw)


@part
def follow_paths(
    pose: Floats, base: int, paths: Floats, points: Floats, epochs: Floats, w: int, now: float,
) -> None:  # fmt: skip
    """Put the bodies of world w, the first of which is ``base``, where their paths say."""
    for k in range(paths.shape[0]):
        b = base + int(paths[k, PATH_BODY])
        elapsed = now - epochs[k, w]
        first, last = int(paths[k, PATH_FIRST]), int(paths[k, PATH_LAST])
        if first == last:
            pose[b, X], pose[b, Y] = paths[k, PATH_START], paths[k, PATH_START + 1]
            pose[b, Z] = paths[k, PATH_START + 2]
            turn_to(pose, b, paths[k, PATH_START + 3] + paths[k, PATH_SPIN] * elapsed)
            continue
        end = points[last - 1, 0]
        if paths[k, PATH_LOOP] != 0.0 and end > 0.0:
            elapsed = elapsed % end
        moment = max(min(elapsed, end), points[first, 0])
        leg = first
        while leg + 2 < last and points[leg + 1, 0] <= moment:
            leg += 1
        since = moment - points[leg, 0]
        pose[b, X] = points[leg, 1] + since * points[leg, 4]
        pose[b, Y] = points[leg, 2] + since * points[leg, 5]
        pose[b, Z] = points[leg, 3] + since * points[leg, 6]
        turn_to(pose, b, paths[k, PATH_START + 3])


@part
def crowded(
    pose: Floats, base: int, robot: int, travel: float, drift: Floats, kinds: Floats,
    pieces: Floats, room: Floats, corner: Floats, reach: float,
) -> int:  # fmt: skip
    """What a robot that goes ``travel`` [m] at most might meet: 0 nothing, 1 statics, 2 bodies.

    ``room`` holds a lower bound of the distance to the nearest static in each cell of a map,
    ``drift`` how far each body may go meanwhile.
    """
    b = base + robot
    x, y = pose[b, X], pose[b, Y]
    column = math.floor((x - corner[0]) * corner[2])
    row = math.floor((y - corner[1]) * corner[2])
    outside = column < 0 or row < 0 or column >= room.shape[1] or row >= room.shape[0]
    wall = outside or room[int(row), int(column)] <= reach + travel
    for k in range(kinds.shape[0]):
        if k == robot:
            continue
        other = base + k
        c, s = pose[other, COS], pose[other, SIN]
        for p in range(int(kinds[k, FIRST_PIECE]), int(kinds[k, LAST_PIECE])):
            cx, cy = pieces[p, CENTRE_X], pieces[p, CENTRE_Y]
            dx = pose[other, X] + c * cx - s * cy - x
            dy = pose[other, Y] + s * cx + c * cy - y
            near = reach + travel + drift[k] + pieces[p, BOUND]
            if dx * dx + dy * dy <= near * near:
                return 2
    return 1 if wall else 0


@part
def update_drive(
    command: Floats, b: int, speeds: Floats, w: int, left: float, right: float, law: Floats,
    matrix: Floats, interval: float,
) -> None:  # fmt: skip
    """One update of the drive: new wheel speeds, and the twist that they give."""
    ramp(speeds, w, left, right, law[LAW_RAMP] * interval if law[LAW_RAMP] > 0.0 else -1.0)
    one, other = speeds[w, 0] / law[LAW_RADIUS], speeds[w, 1] / law[LAW_RADIUS]
    for axis in range(3):
        command[b, axis] = one * matrix[axis, 0] + other * matrix[axis, 1]


@part
def glide(
    w: int, b: int, left: float, right: float, law: Floats, matrix: Floats, dt: float,
    intervals: Floats, speeds: Floats, pose: Floats, goal: Floats, command: Floats,
    velocity: Floats,
) -> bool:  # fmt: skip
    """Go through a control step where nothing is in the way; whether it moved at last."""
    steps = intervals.shape[0]
    i = 0
    moving = False
    while i < steps:
        if not math.isnan(intervals[i]):
            update_drive(command, b, speeds, w, left, right, law, matrix, intervals[i])
        settled = speeds[w, 0] == left and speeds[w, 1] == right
        j = i + 1
        while j < steps and (settled or math.isnan(intervals[j])):
            j += 1
        moving = wanted(b, pose, goal, command, velocity, dt * (j - i))
        if moving:
            arrive(b, pose, goal)
        i = j
    return moving


@part
def wanted(
    b: int, pose: Floats, goal: Floats, command: Floats, velocity: Floats, time: float
) -> bool:
    """Where a body gets as commanded in a time, with nothing in the way; whether that is anywhere."""
    vx, vy, turn = command[b, 0], command[b, 1], command[b, 2]
    velocity[b, 0], velocity[b, 1], velocity[b, 2] = vx, vy, turn
    if vx == 0.0 and vy == 0.0 and turn == 0.0:
        return False
    go(pose, goal, b, vx, vy, turn, time, False)
    return True


@part
def arrive(b: int, pose: Floats, goal: Floats) -> None:
    """Let a body be where it wanted to be."""
    for c in range(6):
        pose[b, c] = goal[b, c]


@part
def last_of(moments: Floats) -> int:
    """Index of the last that is a number; -1 if none is."""
    latest = -1
    for i in range(moments.shape[0]):
        if not math.isnan(moments[i]):
            latest = i
    return latest


@part
def reach_of(speeds: Floats, w: int, left: float, right: float) -> float:
    """The fastest that a wheel goes in this control step [m/s]."""
    now = max(abs(speeds[w, 0]), abs(speeds[w, 1]))
    return float(max(now, abs(left), abs(right)))


@whole
def drive(  # noqa: C901  # the cases of one loop
    first: int, last: int, linear: Floats, angular: Floats, law: Floats, matrix: Floats,
    intervals: Floats, moments: Floats, speeds: Floats, epochs: Floats, paths: Floats,
    points: Floats, drift: Floats, room: Floats, corner: Floats, dt: float, command: Floats,
    velocity: Floats, pose: Floats, goal: Floats, stalled: Table, kinds: Floats, pieces: Floats,
    corners: Floats, grid: Floats, head: Table, follow: Table, cell: Table, statics: Floats,
    cells: Floats, start: Table, items: Table, lanes: Floats, own: Table,
) -> None:  # fmt: skip
    """Make a control step in the worlds first to last.

    Args:
        first: Of the worlds.
        last: The one after the last.
        linear: Wanted speed of the robot in each world [m/s].
        angular: Wanted yaw rate [rad/s].
        law: The drive, see ``tables``.
        matrix: From wheel speeds [rad/s] to the twist, shape (3, 2).
        intervals: Time since the drive's last update at each physics step [s]; NaN: none there.
        moments: Time at each physics step [s] if bodies are put on their paths; NaN if not.
        speeds: Of the wheels [m/s], shape (nworld, 2).
        epochs: When each path began in each world [s], shape (paths, nworld).
        paths: See ``tables``.
        points: Time, x, y, z, and the change of these a second to the next, of way-points.
        drift: How far each body may go in a control step [m].
        room: Map of the distance to statics [m].
        corner: Of that map: x, y [m], and cells a metre.
        dt: Physics step [s].
        command: This and the next ones are the tables of the fleet.
        velocity: See there.
        pose: See there.
        goal: See there.
        stalled: See there.
        kinds: See there.
        pieces: See there.
        corners: See there.
        grid: See there.
        head: See there.
        follow: See there.
        cell: See there.
        statics: See there.
        cells: A finer grid over the statics, as ``kernels_grid`` has it.
        start: First item of each of its cells.
        items: Indices of statics, cell by cell.
        lanes: Nothing, as there is that grid.
        own: ``Fleet.arguments``.
    """
    nbody = kinds.shape[0]
    steps = intervals.shape[0]
    robot = int(law[LAW_BODY])
    latest = last_of(moments)
    for w in range(first, last):
        base = w * nbody
        b = base + robot
        left = linear[w] - angular[w] * law[LAW_HALF]
        right = linear[w] + angular[w] * law[LAW_HALF]
        travel = reach_of(speeds, w, left, right) * dt * steps
        near = crowded(
            pose, base, robot, travel, drift, kinds, pieces, room, corner, law[LAW_REACH]
        )
        if near == 0:
            if glide(
                w, b, left, right, law, matrix, dt, intervals, speeds, pose, goal, command, velocity
            ):
                stalled[b] = False
            if latest >= 0:
                follow_paths(pose, base, paths, points, epochs, w, moments[latest])
            relink(base, base + nbody, nbody, grid, pose, head, follow, cell)
            continue
        for i in range(steps):
            if not math.isnan(moments[i]):
                follow_paths(pose, base, paths, points, epochs, w, moments[i])
                relink(base, base + nbody, nbody, grid, pose, head, follow, cell)
            if not math.isnan(intervals[i]):
                update_drive(command, b, speeds, w, left, right, law, matrix, intervals[i])
            step = reach_of(speeds, w, left, right) * dt
            near = crowded(
                pose, base, robot, step, drift, kinds, pieces, room, corner, law[LAW_REACH]
            )
            if near == 2:
                advance(base, base + nbody, 1, *own)
                continue
            if wanted(b, pose, goal, command, velocity, dt):
                stalled[b] = False
                if near == 1:
                    stalled[b] = statics_meet(
                        b, robot, kinds, pieces, corners, goal, statics, cells, start, items, lanes
                    )
                if not stalled[b]:
                    arrive(b, pose, goal)
            relink(b, b + 1, nbody, grid, pose, head, follow, cell)


@whole
def restart(
    w: int, initial: Floats, now: Floats, speeds: Floats, epochs: Floats, command: Floats,
    velocity: Floats, stalled: Table, pose: Floats, nbody: int, grid: Floats, head: Table,
    follow: Table, cell: Table,
) -> None:  # fmt: skip
    """Put a world back to how it was made; paths begin ``now[0]`` [s]."""
    speeds[w, 0] = speeds[w, 1] = 0.0
    for k in range(epochs.shape[0]):
        epochs[k, w] = now[0]
    base = w * nbody
    for k in range(nbody):
        b = base + k
        for c in range(pose.shape[1]):
            pose[b, c] = initial[k, c]
        for axis in range(3):
            command[b, axis] = velocity[b, axis] = 0.0
        stalled[b] = False
    relink(base, base + nbody, nbody, grid, pose, head, follow, cell)


@kernel
def begin(worlds: Worlds, starting: Table) -> None:
    """Put worlds back to how they were made; the tuple holds what ``restart`` takes."""
    for w in worlds:
        restart(w, *starting)


@kernel
def measure_room(
    room: Table, corner: Floats, segments: Floats, discs: Floats,
) -> None:  # fmt: skip
    """Fill a map with lower bounds of the distance from anywhere in a cell to the nearest static.

    Args:
        room: The map, shape (rows, columns).
        corner: x and y of its corner [m], cells a metre.
        segments: Ends of segments [m], shape (n, 4).
        discs: Middle and radius of discs [m], shape (m, 3).
    """
    side = 1.0 / corner[2]
    slack = side * math.sqrt(0.5) + 1e-6
    for r in range(room.shape[0]):
        y = corner[1] + (r + 0.5) * side
        for q in range(room.shape[1]):
            x = corner[0] + (q + 0.5) * side
            best = np.inf
            for i in range(segments.shape[0]):
                ax, ay = segments[i, 0], segments[i, 1]
                ex, ey = segments[i, 2] - ax, segments[i, 3] - ay
                square = ex * ex + ey * ey
                t = 0.0
                if square > 0.0:
                    t = min(max(((x - ax) * ex + (y - ay) * ey) / square, 0.0), 1.0)
                dx, dy = ax + t * ex - x, ay + t * ey - y
                best = min(best, dx * dx + dy * dy)
            best = math.sqrt(best)
            for i in range(discs.shape[0]):
                dx, dy = discs[i, 0] - x, discs[i, 1] - y
                best = min(best, math.sqrt(dx * dx + dy * dy) - discs[i, 2])
            room[r, q] = best - slack
