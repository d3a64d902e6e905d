"""A control step of a TurtleBot3 task from commands to the first moment of the next episode."""

# ruff: noqa: FBT001  # kernels take their arguments in order

from __future__ import annotations

import math

import numpy as np

from gazelle.engines.native import fetch_add, kernel, part
from gazelle.engines.planar.columns import X, Y
from gazelle.envs.planar.kernels_drive import drive, restart
from gazelle.envs.planar.kernels_lidar import report, see, uniforms
from gazelle.envs.planar.tables import Flags, Floats, Indices, Table
from gazelle.envs.turtlebot3.kernels_judge import judge, observe, round2
from gazelle.envs.turtlebot3.rules import NO_GOAL, SHORTEST

_BLOCK = 32  # worlds whose ranges stay near the processor until they are judged

# What comes out is there twice: of now, and of the episode that ended, if one did.
NOW, LAST = 0, 1
SUCCESS, COLLISION, TIMEOUT, HOW = range(4)
TERMINATED, TRUNCATED, DONE, ENDS = range(4)
DISTANCE, HEADING, NUMBERS = range(3)
POINTS = 4  # goal and robot, x and y of each


@part
def drawn(w: int, keys: Table, counters: Table, count: int) -> int:
    """The next whole number below ``count`` of a world's stream."""
    number = np.empty(1)
    uniforms(keys[w], counters[w], number)
    counters[w] += np.uint64(1)
    return int(number[0] * count)


@part
def next_goal(
    w: int, goal: Table, counts: Table, successors: Table, keys: Table, counters: Table
) -> None:
    """A goal that may follow a world's last one."""
    place = goal[w]
    goal[w] = successors[place, drawn(w, keys, counters, counts[place])]


@part
def first_goal(
    w: int, goal: Table, places: int, start: int, respawn: bool, keys: Table, counters: Table
) -> None:
    """The goal of a new episode; with ``respawn`` it stays over collisions and time-outs."""
    if not respawn:
        goal[w] = drawn(w, keys, counters, places)
    elif goal[w] == NO_GOAL:
        goal[w] = start


@part
def distance_to_goal(b: int, pose: Floats, goals: Floats, place: int) -> float:
    """How far a body is from a place [m], rounded as the observation is."""
    return float(round2(math.hypot(goals[place, 0] - pose[b, X], goals[place, 1] - pose[b, Y])))


@part
def write_points(points: Floats, w: int, goals: Floats, place: int, pose: Floats, b: int) -> None:
    """Let a place come out as a world's goal, and where its robot is."""
    points[NOW, w, 0], points[NOW, w, 1] = goals[place, 0], goals[place, 1]
    points[NOW, w, 2], points[NOW, w, 3] = pose[b, X], pose[b, Y]


@part
def keep(w: int, over: bool, how: Flags, numbers: Floats, counts: Indices, points: Floats) -> None:
    """Put what came out of an episode that is over where it stays; zeros if it is not."""
    for k in range(HOW):
        how[LAST, k, w] = over and how[NOW, k, w]
    for k in range(NUMBERS):
        numbers[LAST, k, w] = numbers[NOW, k, w] if over else 0.0
    counts[LAST, w] = counts[NOW, w] if over else 0
    for axis in range(POINTS):
        points[LAST, w, axis] = points[NOW, w, axis] if over else 0.0


@part
def conclude(
    w: int, b: int, pose: Floats, goals: Floats, goal: Table, elapsed: Indices, most: int,
    respawn: bool, counts_of: Table, successors: Table, keys: Table, counters: Table,
    start_distance: Floats, crashed: Flags, arrived: Flags, ends: Flags, how: Flags,
    numbers: Floats, counts: Indices, points: Floats,
) -> bool:  # fmt: skip
    """Write down what a step brought, and give who has arrived a goal; whether it ends here."""
    elapsed[w] += 1
    late = 0 < most <= elapsed[w]
    ended = crashed[w] or (arrived[w] and not respawn)
    if arrived[w]:
        counts[NOW, w] += 1
        if respawn:
            next_goal(w, goal, counts_of, successors, keys, counters)
            start_distance[w] = max(distance_to_goal(b, pose, goals, goal[w]), SHORTEST)
    write_points(points, w, goals, goal[w], pose, b)
    over = ended or late
    how[NOW, SUCCESS, w], how[NOW, COLLISION, w] = arrived[w], crashed[w] and not arrived[w]
    how[NOW, TIMEOUT, w] = late and not ended
    ends[TERMINATED, w], ends[TRUNCATED, w], ends[DONE, w] = ended, late, over
    keep(w, over, how, numbers, counts, points)
    return over


@kernel
def step(
    tickets: Indices, nworld: int, driving: Table, seeing: Table, reporting: Table,
    observing: Table, judging: Table, starting: Table, pose: Floats, nbody: int, robot: int,
    goals: Floats, goal: Table, first: int, elapsed: Indices, most: int, respawn: bool,
    counts_of: Table, successors: Table, keys: Table, counters: Table, start_distance: Floats,
    crashed: Flags, arrived: Flags, observation: Table, last_observation: Table, ends: Flags,
    how: Flags, numbers: Floats, counts: Indices, points: Floats, goes_on: bool,
) -> None:  # fmt: skip
    """Make a control step in blocks of worlds until none is left for this thread.

    Args:
        tickets: How many worlds threads have taken, shared by all of them; 0 before.
        nworld: How many there are.
        driving: What ``drive`` takes after the range of worlds.
        seeing: What ``see`` takes after it.
        reporting: What ``report`` takes after it.
        observing: What ``observe`` takes after it; distances and headings are ``numbers[NOW]``.
        judging: What ``judge`` takes after it.
        starting: What ``kernels_drive.restart`` takes after the world.
        pose: Of all bodies.
        nbody: Bodies of a world.
        robot: Which of them it is about.
        goals: Places that are goals [m], shape (m, 2).
        goal: The place of each world's goal.
        first: The place of the very first one, with ``respawn``.
        elapsed: Control steps of each world's episode.
        most: Control steps that an episode has at most; 0 for any number.
        respawn: Whether an episode goes on where a goal is reached.
        counts_of: How many places may follow each place.
        successors: Which ones.
        keys: Of the stream that goals are drawn from.
        counters: Numbers drawn from it so far.
        start_distance: Distance to the goal when it was given [m].
        crashed: As ``judge`` has it.
        arrived: As ``judge`` has it.
        observation: As ``observe`` has it; of the next episode where one began.
        last_observation: The last one, where an episode ended.
        ends: Comes out, shape (ENDS, nworld).
        how: Comes out, shape (2, HOW, nworld).
        numbers: Comes out, shape (2, NUMBERS, nworld).
        counts: Comes out, goals reached in the episode, shape (2, nworld).
        points: Comes out, goals and robots (x, y) [m], shape (2, nworld, POINTS).
        goes_on: Whether the next episode begins where one ended.
    """
    begin = fetch_add(tickets, _BLOCK)
    while begin < nworld:
        end = min(begin + _BLOCK, nworld)
        drive(begin, end, *driving)
        see(begin, end, *seeing)
        report(begin, end, *reporting)
        observe(begin, end, *observing)
        judge(begin, end, *judging)
        for w in range(begin, end):
            over = conclude(
                w, w * nbody + robot, pose, goals, goal, elapsed, most, respawn, counts_of,
                successors, keys, counters, start_distance, crashed, arrived, ends, how, numbers,
                counts, points,
            )  # fmt: skip
            if not (over and goes_on):
                continue
            for k in range(observation.shape[1]):
                last_observation[w, k] = observation[w, k]
            restart(w, *starting)
            elapsed[w], counts[NOW, w] = 0, 0
            first_goal(w, goal, goals.shape[0], first, respawn, keys, counters)
            see(w, w + 1, *seeing)
            report(w, w + 1, *reporting)
            observe(w, w + 1, *observing)
            start_distance[w] = max(numbers[NOW, DISTANCE, w], SHORTEST)
            write_points(points, w, goals, goal[w], pose, w * nbody + robot)
            for k in range(HOW):
                how[NOW, k, w] = False
        begin = fetch_add(tickets, _BLOCK)
