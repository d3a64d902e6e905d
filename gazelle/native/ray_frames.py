# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="misc"
"""Rays that frames carry: where they are in the world, and what distances mean."""

from __future__ import annotations

from typing import Any

import cython
import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats

INF = cython.declare(cython.double, float("inf"))


def carried_rays(
    position: Floats, quaternion: Floats, origins: Floats, directions: Floats, beside: Floats
) -> tuple[Floats, Floats]:
    """Return origins and directions of rays in the world, shape (n, frames * rays, 3) each.

    Args:
        position: Of the frames [m], shape (n, frames, 3).
        quaternion: (x, y, z, w), of length one, shape (n, frames, 4).
        origins: In the frames [m], shape (frames, rays, 3).
        directions: Unit vectors in the frames, likewise.
        beside: Added to every origin [m], shape (3,).
    """
    count = origins.shape[0] * origins.shape[1]
    start, along = np.empty((2, len(position), count, 3))
    place, turned = np.ascontiguousarray(position), np.ascontiguousarray(quaternion)
    aim(place, turned, origins, directions, beside, start, along)
    return start, along


def aim(
    position: Any,
    quaternion: Any,
    origins: Any,
    directions: Any,
    beside: Any,
    start: Any,
    along: Any,
) -> None:
    """Write what ``carried_rays`` returns."""
    rays = origins.shape[1]
    for n in range(position.shape[0]):
        for frame in range(origins.shape[0]):
            x, y = quaternion[n, frame, 0], quaternion[n, frame, 1]
            z, w = quaternion[n, frame, 2], quaternion[n, frame, 3]
            px = position[n, frame, 0] + beside[0]
            py = position[n, frame, 1] + beside[1]
            pz = position[n, frame, 2] + beside[2]
            for ray in range(rays):
                at = frame * rays + ray
                a, b, c = origins[frame, ray, 0], origins[frame, ray, 1], origins[frame, ray, 2]
                i, j, k = 2.0 * (y * c - z * b), 2.0 * (z * a - x * c), 2.0 * (x * b - y * a)
                start[n, at, 0] = px + (a + w * i + (y * k - z * j))
                start[n, at, 1] = py + (b + w * j + (z * i - x * k))
                start[n, at, 2] = pz + (c + w * k + (x * j - y * i))
                a, b = directions[frame, ray, 0], directions[frame, ray, 1]
                c = directions[frame, ray, 2]
                i, j, k = 2.0 * (y * c - z * b), 2.0 * (z * a - x * c), 2.0 * (x * b - y * a)
                along[n, at, 0] = a + w * i + (y * k - z * j)
                along[n, at, 1] = b + w * j + (z * i - x * k)
                along[n, at, 2] = c + w * k + (x * j - y * i)


def settle(distance: Any, normal: Any, along: Any, geom: Any, sheet: Any, inside: Any) -> None:
    """Set the hit as ``met_from_inside`` says."""
    for n in range(distance.shape[0]):
        for ray in range(distance.shape[1]):
            out = (
                normal[n, ray, 0] * along[n, ray, 0]
                + normal[n, ray, 1] * along[n, ray, 1]
                + normal[n, ray, 2] * along[n, ray, 2]
            )
            if distance[n, ray] < 0.0:
                distance[n, ray] = INF
            inside[n, ray] = out > 0.0 and geom[n, ray] >= 0 and sheet[geom[n, ray]] == 0


def met_from_inside(
    distance: Floats, normal: Floats, along: Floats, geom: NDArray[np.int32], sheet: Bools
) -> Bools:
    """Return which rays met something from inside, shape (n, rays); misses become infinite.

    Args:
        distance: Less than zero for nothing [m], shape (n, rays); changed.
        normal: Of the surfaces that were met, shape (n, rays, 3).
        along: Directions of the rays, likewise.
        geom: Index of the geom that was hit, shape (n, rays); negative for nothing.
        sheet: Things that have no inside, shape (geoms,).
    """
    inside = np.empty(distance.shape, np.uint8)
    settle(distance, normal, along, geom, sheet.view(np.uint8), inside)
    return inside.view(np.bool_)
