"""How bodies are turned, as angles."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats


def roll_pitch_yaw(quaternion: Floats) -> Floats:
    """Angles about fixed x, y and z, one after the other, as ROS' tf counts them.

    Args:
        quaternion: (x, y, z, w), shape (n, 4).

    Returns:
        Roll and yaw in [-pi, pi], pitch in [-pi/2, pi/2] [rad], shape (n, 3).
    """
    x, y, z, w = quaternion.T
    roll = np.arctan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2.0 * (w * y - z * x), -1.0, 1.0))
    yaw = np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    return np.column_stack((roll, pitch, yaw))
