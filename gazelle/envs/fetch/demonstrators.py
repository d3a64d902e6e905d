"""How objects are picked, by hand: what a learner may be shown."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats32
from gazelle.envs.fetch.figures import CONTROL_PERIOD, LARGEST_STEP, SHARE

_GRIP, _OBJECT, _OPENING = slice(6, 9), slice(9, 12), slice(15, 17)
_CLOSING, _GOAL = slice(29, 31), slice(3, 6)
_ABOVE = 0.08  # the object, from where the gripper comes down [m]
_ASIDE = 0.012  # of the object, where the gripper may come down [m]
_THERE = 0.02  # where fingers close on it [m]
_SHUT = 0.045  # that fingers are open at most where they hold it [m]
_STILL = 2e-3  # that they move in a step then, at most [m]
_LIFTED = 0.03  # to carry it over the table [m]


def pick_and_place(rows: Floats32) -> Floats32:
    """Actions that pick the object and carry it to its goal, from what is seen alone.

    Args:
        rows: Observations in a row, shape (n, 31): what is achieved, the goal, and the 25 entries
            that `FetchEnv` lists.

    Returns:
        Shape (n, 4).
    """
    grip, place, goal = rows[:, _GRIP], rows[:, _OBJECT], rows[:, _GOAL]
    away, left = place - grip, goal - place
    closing = np.abs(rows[:, _CLOSING]).max(axis=1)
    shut = (rows[:, _OPENING].max(axis=1) < _SHUT) & (closing < _STILL)
    apart = np.linalg.norm(away, axis=1)
    around = apart < _THERE
    held = around & shut
    away[:, 2] += _ABOVE * (np.linalg.norm(away[:, :2], axis=1) > _ASIDE)
    left[:, 2] += _LIFTED * (np.linalg.norm(left[:, :2], axis=1) > _LIFTED)
    told = np.clip(np.where(held[:, None], 0.6 * left, away) / (SHARE * LARGEST_STEP), -1.0, 1.0)
    fingers = np.where(around, -1.0, 1.0)
    return np.hstack((told, fingers[:, None])).astype(np.float32)


_OVER = 0.08  # the object, where the gripper passes it [m]
_BEHIND = 0.085  # the object, where the gripper comes down [m]
_TOUCHING = 0.07
_BRAKING = 0.8
_ENOUGH = 0.012


def push(rows: Floats32) -> Floats32:
    grip, place, goal = rows[:, _GRIP], rows[:, _OBJECT], rows[:, _GOAL]
    left = (goal - place)[:, :2]
    far = np.linalg.norm(left, axis=1)
    ahead = left / np.maximum(far, 1e-6)[:, None]
    away = place - grip
    along = np.sum(away[:, :2] * ahead, axis=1)
    across = away[:, :2] - along[:, None] * ahead
    off = np.linalg.norm(across, axis=1)
    low = np.abs(away[:, 2]) < 0.025
    touching = along < _TOUCHING
    pushing = low & (along > 0.0) & (off < np.where(touching, 0.025, 0.012))
    start = away[:, :2] - _BEHIND * ahead
    over = np.linalg.norm(start, axis=1) < 0.015
    # Over the object to behind it, down, and on.
    up = away[:, 2] + np.where(over, 0.0, _OVER)
    crossing = ~over & (up > 0.03)
    way = np.hstack((np.where(crossing[:, None], 0.0, start), up[:, None]))
    speed = np.minimum(0.66*0.05/0.04, np.sqrt(2.0 * _BRAKING * np.maximum(far-0.003,0))) * CONTROL_PERIOD
    speed = np.where(touching, speed, np.minimum(speed, 0.02))
    ahead_way = ahead * speed[:, None] + 0.5 * across
    way = np.where(pushing[:, None], np.hstack((ahead_way, away[:, 2:])), way)
    way[far < _ENOUGH] = 0.0
    told = np.clip(way / (SHARE * LARGEST_STEP), -1.0, 1.0)
    return np.hstack((told, np.zeros((len(rows), 1)))).astype(np.float32)
