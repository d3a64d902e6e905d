"""Demonstrators that move objects by hand-written rules; see `gazelle.training.demonstrations`.

Both say from one observation alone what to do. They take rows of shape (n, 31), what is achieved,
the goal and the 25 entries that `FetchEnv` lists, and give actions of shape (n, 4).
"""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats, Floats32
from gazelle.envs.fetch.figures import CONTROL_PERIOD, LARGEST_STEP, SHARE

_GOAL, _GRIPPER, _OBJECT = slice(3, 6), slice(6, 9), slice(9, 12)
_OPENING, _CLOSING = slice(15, 17), slice(29, 31)
_OVER = 0.08  # the object, where the gripper passes it [m]
_FASTEST = SHARE * LARGEST_STEP  # way in a step [m]

_ASIDE = 0.012  # of the object, where the gripper comes down over it, at most [m]
_AROUND = 0.02  # the object is the gripper, where fingers close on it [m]
_SHUT = 0.045  # that fingers are open at most where they hold it [m]
_STILL = 2e-3  # that they move in a step then, at most [m]
_LIFTED = 0.03  # to carry it over the table [m]
_CARRYING = 0.6  # share of the way that is left, in a step

_BEHIND = 0.085  # the object, where the gripper comes down [m]
_TOUCHING = 0.07  # the object is the gripper at most, where it may push [m]
_AT_HEIGHT = 0.025  # of the object, within which the gripper is beside it [m]
_BESIDE = 0.025  # the line to the goal, where an object is still pushed along it [m]
_MEETING = 0.02  # way in a step that comes nearer to the object [m]
_BRAKING = 0.8  # before the goal, so that what slides does not slide on [m/s2]
_ENOUGH = 0.012  # from the goal [m]


def pick_and_place(rows: Floats32) -> Floats32:
    """Return actions: over the object, down with open fingers, close them, and up to the goal."""
    seen = rows.astype(np.float64)
    place = seen[:, _OBJECT]
    away, left = place - seen[:, _GRIPPER], seen[:, _GOAL] - place
    around = np.linalg.norm(away, axis=1) < _AROUND
    shut = seen[:, _OPENING].max(axis=1) < _SHUT
    held = around & shut & (np.abs(seen[:, _CLOSING]).max(axis=1) < _STILL)
    away[:, 2] += _OVER * (np.linalg.norm(away[:, :2], axis=1) > _ASIDE)
    left[:, 2] += _LIFTED * (np.linalg.norm(left[:, :2], axis=1) > _LIFTED)
    way = np.where(held[:, None], _CARRYING * left, away)
    return _actions(way, np.where(around, -1.0, 1.0))


def push(rows: Floats32) -> Floats32:
    """Return actions: over the object to behind it, down, and towards the goal, ever slower."""
    seen = rows.astype(np.float64)
    place = seen[:, _OBJECT]
    left, away = (seen[:, _GOAL] - place)[:, :2], place - seen[:, _GRIPPER]
    far = np.linalg.norm(left, axis=1)
    ahead = left / np.maximum(far, 1e-6)[:, None]
    along = np.sum(away[:, :2] * ahead, axis=1)
    across = away[:, :2] - along[:, None] * ahead
    off = np.linalg.norm(across, axis=1)
    touching = along < _TOUCHING
    behind = (along > 0.0) & (off < np.where(touching, _BESIDE, _ASIDE))
    speed = np.minimum(np.sqrt(2.0 * _BRAKING * far) * CONTROL_PERIOD, _FASTEST)
    speed = np.where(touching, speed, np.minimum(speed, _MEETING))
    on = ahead * speed[:, None] + 0.5 * across
    pushing = behind & (np.abs(away[:, 2]) < _AT_HEIGHT)
    way = np.where(pushing[:, None], np.hstack((on, away[:, 2:])), _around(away, ahead))
    way[far < _ENOUGH] = 0.0
    return _actions(way, np.zeros(len(rows)))


def _around(away: Floats, ahead: Floats) -> Floats:
    """Return the way to behind an object, up first where that is aside, shape (n, 3)."""
    start = away[:, :2] - _BEHIND * ahead
    there = np.linalg.norm(start, axis=1) < _ASIDE
    up = away[:, 2] + np.where(there, 0.0, _OVER)
    rising = ~there & (up > _LIFTED)
    return np.hstack((np.where(rising[:, None], 0.0, start), up[:, None]))


def _actions(way: Floats, fingers: Floats) -> Floats32:
    """Return actions of gripper displacements in a step [m] and finger commands."""
    command = np.clip(way / _FASTEST, -1.0, 1.0)
    return np.hstack((command, fingers[:, None])).astype(np.float32)
