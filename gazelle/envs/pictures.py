"""Pictures of environments, and marks on them that show what is in no world: the goal."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from gazelle.array_types import Floats, Picture
from gazelle.rendering import PinholeLens
from gazelle.sensors import View
from gazelle.sensors.rendering import directions_of_view
from gazelle.simulation import Simulation

GOAL_COLOUR = (220, 30, 30)
_THICK = 0.005  # what is nearer to the ground than this does not hide a mark on it [m]


def take(simulation: Simulation, view: View, world: int) -> tuple[Picture, Floats]:
    """Return a picture by the rasteriser, fast enough for every step of an episode.

    Args:
        simulation: Of the environment; the caller owns its state.
        view: From where; of its samples there is one a pixel.
        world: World.

    Returns:
        The picture, shape (height, width, 3), and the distances to what the middles of pixels
        show [m], shape (height, width), infinite where nothing is.
    """
    lens = PinholeLens(view.width, view.height, view.horizontal_fov)
    frames = simulation.live_scene.render(
        lens,
        np.array([view.pose.position]),
        np.array([view.pose.quaternion]),
        np.array([world]),
        want=("color", "depth"),
    )
    return frames.color[0], frames.depth[0] * _slants(lens)


@lru_cache(maxsize=8)
def _slants(lens: PinholeLens) -> Floats:
    """Return the ratio of each pixel's ray length to its depth, shape (height, width)."""
    across = (np.arange(lens.width) + 0.5 - lens.width / 2.0) / lens.focal
    down = (np.arange(lens.height) + 0.5 - lens.height / 2.0) / lens.focal
    return np.sqrt(1.0 + across[None] ** 2 + down[:, None] ** 2)


def mark_square(
    picture: Picture, view: View, ranges: Floats, centre: tuple[float, float], side: float
) -> Picture:
    """Draw a half transparent square on the ground, where nothing stands before or on it.

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


@lru_cache(maxsize=8)
def ground_points(view: View) -> tuple[Floats, Floats]:
    """Return the intersection of each pixel's central ray with the ground z = 0.

    Returns:
        x and y in the world frame [m], shape (height, width, 2), and the distance to there [m],
        shape (height, width); NaN above the horizon. Both are kept, and cannot be written to.
    """
    rays = directions_of_view(view, samples=1).reshape(view.height, view.width, 3)
    eye = np.asarray(view.pose.position)
    drop = np.where(rays[..., 2] < 0.0, rays[..., 2], np.nan)
    away: Floats = -eye[2] / drop
    points: Floats = eye[:2] + away[..., None] * rays[..., :2]
    points.flags.writeable = away.flags.writeable = False
    return points, away
