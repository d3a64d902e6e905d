"""Motion of a body in space under constant acceleration, as ``robot_localization`` models it.

The state has 15 elements: position in the world [m], roll, pitch and yaw [rad], linear velocity in the
body's frame [m/s], angular velocity in it [rad/s], and linear acceleration in it [m/s^2].
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.array_types import Floats

SIZE = 15
POSITION, ANGLES, LINEAR, ANGULAR, ACCELERATION = (slice(i, i + 3) for i in range(0, SIZE, 3))
POSE, TWIST = slice(0, 6), slice(6, 12)
NAMES = (
    "x", "y", "z", "roll", "pitch", "yaw", "vx", "vy", "vz", "vroll", "vpitch", "vyaw", "ax", "ay", "az",
)  # fmt: skip


def rotation(roll: Any, pitch: Any, yaw: Any) -> Floats:
    """Return Rz(yaw) Ry(pitch) Rx(roll), shape (3, 3, ...), of angles of shape (...)."""
    sr, cr, sp, cp = np.sin(roll), np.cos(roll), np.sin(pitch), np.cos(pitch)
    sy, cy = np.sin(yaw), np.cos(yaw)
    return np.array((
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    ))  # fmt: skip


def rotated_covariance(turn: Floats, covariance: Floats) -> Floats:
    """Return a covariance of two vectors, shape (6, 6), after a rotation of both, shape (3, 3)."""
    both = np.zeros((6, 6))
    both[:3, :3] = both[3:, 3:] = turn
    return np.asarray(both @ covariance @ both.T)


def angle_rates(roll: Any, pitch: Any, angular: Any) -> Floats:
    """Return the rates of roll, pitch and yaw, shape (3, ...), by an angular velocity of the body.

    Args:
        roll: [rad], shape (...).
        pitch: [rad], shape (...).
        angular: [rad/s], in the body's frame; three of shape (...).
    """
    p, q, r = angular
    sr, cr = np.sin(roll), np.cos(roll)
    turn = sr * q + cr * r
    return np.array((p + np.tan(pitch) * turn, cr * q - sr * r, turn / np.cos(pitch)))


def moved(states: Floats, seconds: float) -> Floats:
    """Return states, shape (n, 15), after a time [s]; angles are not wrapped."""
    state = states.T
    after = state.copy()
    step = seconds * (state[LINEAR] + 0.5 * seconds * state[ACCELERATION])
    after[POSITION] += np.einsum("ijn,jn->in", rotation(*state[ANGLES]), step)
    after[ANGLES] += seconds * angle_rates(state[3], state[4], state[ANGULAR])
    after[LINEAR] += seconds * state[ACCELERATION]
    return np.ascontiguousarray(after.T)


def moved_with_jacobian(state: Floats, seconds: float) -> tuple[Floats, Floats]:
    """Return a state, shape (15,), after a time [s], and its derivatives by the state, shape (15, 15).

    The rotation's derivatives are cross products: dR u/droll = R (e_x x u), dR u/dpitch = R (Rx' e_y x u)
    and dR u/dyaw = e_z x R u.
    """
    _, _, _, roll, pitch, yaw, vx, vy, vz, p, q, r, ax, ay, az = state.tolist()
    t, half = seconds, 0.5 * seconds * seconds
    turn = rotation(roll, pitch, yaw)
    u0, u1, u2 = t * vx + half * ax, t * vy + half * ay, t * vz + half * az
    sr, cr, cp, tp = math.sin(roll), math.cos(roll), math.cos(pitch), math.tan(pitch)
    columns = turn @ ((u0, 0.0, cr * u2 + sr * u1), (u1, -u2, -sr * u0), (u2, u1, -cr * u0))
    across, along = sr * q + cr * r, cr * q - sr * r

    after = state.copy()
    after[POSITION] += columns[:, 0]
    after[ANGLES] += (t * (p + tp * across), t * along, t * across / cp)
    after[LINEAR] += (t * ax, t * ay, t * az)

    slope = np.eye(SIZE)
    slope[0:3, 3:5] = columns[:, 1:]
    slope[0, 5], slope[1, 5] = -columns[1, 0], columns[0, 0]
    slope[POSITION, LINEAR] = t * turn
    slope[POSITION, ACCELERATION] = half * turn
    slope[3:6, 3:5] += (
        (t * tp * along, t * across / (cp * cp)),
        (-t * across, 0.0),
        (t * along / cp, t * tp * across / cp),
    )
    slope[ANGLES, ANGULAR] = (
        (t, t * sr * tp, t * cr * tp),
        (0.0, t * cr, -t * sr),
        (0.0, t * sr / cp, t * cr / cp),
    )
    slope[6, 12] = slope[7, 13] = slope[8, 14] = t
    return after, slope
