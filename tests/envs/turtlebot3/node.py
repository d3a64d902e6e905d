"""One step of the published node, read as one robot's: lists, Python's arithmetic, no arrays."""

from __future__ import annotations

import math

import numpy as np

COLLISION = {1: -200, 2: -150, 3: -150, 4: -500}
GOAL = {1: 200, 2: 200, 3: 200, 4: 1000}
TOO_NEAR = 0.12  # a range of -inf, in which the node saw no collision, counts as this here


def seen(ranges):
    """Return the node's ranges of a message's, whose numbers are of single precision."""
    replaced = {math.inf: 3.5, -math.inf: float(np.float32(TOO_NEAR))}
    return [0 if math.isnan(r) else replaced.get(r, r) for r in map(float, ranges)]


def distance(position, goal):
    return round(math.hypot(goal[0] - position[0], goal[1] - position[1]), 2)


def heading(position, yaw, goal):
    angle = math.atan2(goal[1] - position[1], goal[0] - position[0]) - yaw
    if angle > math.pi:
        angle -= 2 * math.pi
    elif angle < -math.pi:
        angle += 2 * math.pi
    return round(angle, 2)


def state(stage, ranges, position, yaw, goal):
    """Return the network's input, whether it is a collision, and whether the goal is reached."""
    scan = seen(ranges)
    shortest = min(scan)
    away = distance(position, goal)
    numbers = [*scan, heading(position, yaw, goal), away]
    if stage > 1:
        numbers += [round(shortest, 2), scan.index(shortest)]
    return numbers, 0 < shortest < 0.13, away < 0.2


def reward(stage, numbers, action, start_distance, *, collided, arrived):
    """Return the node's reward for a state of ``state``."""
    count = len(numbers) - (2 if stage == 1 else 4)
    angle, away = numbers[count], numbers[count + 1]
    phi = -math.pi / 4 + angle + (math.pi / 8 * action) + math.pi / 2
    part, _ = math.modf(0.25 + 0.5 * phi % (2 * math.pi) / math.pi)
    pay = round(5 * (1 - 4 * math.fabs(0.5 - part)), 2) * 2 ** (away / start_distance)
    if stage == 4 and numbers[count + 2] < 0.5:
        pay += -5
    if collided:
        pay = COLLISION[stage]
    return GOAL[stage] if arrived else pay
