"""Marks on pictures that show what is in no world: the goal."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats, Picture
from gazelle.sensors import View
from gazelle.sensors.rendering import directions_of_view

GOAL_COLOUR = (220, 30, 30)
_THICK = 0.005  # what is nearer to the ground than this does not hide a mark on it [m]


def mark_square(
    picture: Picture, view: View, ranges: Floats, centre: tuple[float, float], side: float
) -> Picture:
    """Tint a square on the ground, half transparent, where nothing stands before or on it.

    Args:
        picture: Shape (height, width, 3).
        view: From where the picture was taken.
        ranges: Distances to what the middles of pixels show, shape (height, width) [m].
        centre: Of the square in the world frame [m].
        side: Of the square, along x and y [m].

    Returns:
        A new picture.
    """
    ground, away = ground_points(view)
    inside = (np.abs(ground - centre) <= side / 2.0).all(axis=2)
    height = view.pose.position[2]
    inside &= ranges >= away * (1.0 - _THICK / height)  # alike triangles
    marked = picture.copy()
    tinted = (marked[inside].astype(np.uint16) + np.array(GOAL_COLOUR, dtype=np.uint16)) // 2
    marked[inside] = tinted.astype(np.uint8)
    return marked


def ground_points(view: View) -> tuple[Floats, Floats]:
    """Where the ray through each pixel's middle meets the ground z = 0.

    Returns:
        x and y in the world frame [m], shape (height, width, 2), and the distance to there [m],
        shape (height, width); NaN above the horizon.
    """
    rays = directions_of_view(view, samples=1).reshape(view.height, view.width, 3)
    eye = np.asarray(view.pose.position)
    drop = np.where(rays[..., 2] < 0.0, rays[..., 2], np.nan)
    away: Floats = -eye[2] / drop
    return eye[:2] + away[..., None] * rays[..., :2], away
