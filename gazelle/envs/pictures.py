"""Marks on pictures that show what is in no world: the goal."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gazelle.sensors import View

Float64 = NDArray[np.float64]
Picture = NDArray[np.uint8]

GOAL_COLOUR = (220, 30, 30)


def mark_square(picture: Picture, view: View, centre: tuple[float, float], side: float) -> Picture:
    """Tint a square on the ground, half transparent; things that stand on it are tinted too.

    Args:
        picture: Shape (height, width, 3).
        view: From where the picture was taken.
        centre: Of the square in the world frame [m].
        side: Of the square, along x and y [m].

    Returns:
        A new picture.
    """
    ground = ground_points(view)
    inside = (np.abs(ground - centre) <= side / 2.0).all(axis=2)
    marked = picture.copy()
    tinted = (marked[inside].astype(np.uint16) + np.array(GOAL_COLOUR, dtype=np.uint16)) // 2
    marked[inside] = tinted.astype(np.uint8)
    return marked


def ground_points(view: View) -> Float64:
    """Where the ray through each pixel's middle meets the ground z = 0.

    Returns:
        x and y in the world frame [m], shape (height, width, 2); NaN above the horizon.
    """
    focal = view.width / 2.0 / math.tan(view.horizontal_fov / 2.0)
    left = (view.width / 2.0 - 0.5 - np.arange(view.width)) / focal
    up = (view.height / 2.0 - 0.5 - np.arange(view.height)) / focal
    y, z = np.meshgrid(left, up)
    rays = np.stack((np.ones_like(y), y, z), axis=-1) @ view.pose.matrix()[:3, :3].T
    eye = np.asarray(view.pose.position)
    drop = np.where(rays[..., 2] < 0.0, rays[..., 2], np.nan)
    points: Float64 = eye[:2] - (eye[2] / drop)[..., None] * rays[..., :2]
    return points
