"""Pictures of extruded outlines: flat faces drawn into pixels by their inverse depths.

The inverse of the depth along the optical axis is linear in a picture (the depth buffer of
any graphics card works so), which makes every covered pixel exact. A pixel is what its middle
sees.
"""

from __future__ import annotations

import math
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gazelle.engines.native import kernel, part
from gazelle.engines.planar.columns import COS, SIN, X, Y, Z
from gazelle.engines.planar.tables import Floats, Indices

Bytes: TypeAlias = NDArray[np.uint8]

# Faces: four corners x, y, z [m] around a convex polygon, counter-clockwise seen from its front,
# the first of a triangle twice; red, green and blue from 0 to 255; and a number of the thing
# that it is a face of. From behind, where it is solid, nothing is seen.
RED: Final = 12
OWNER: Final = 15
FACE: Final = 16

# Cameras: place [m]; the directions of right, down and forward in the world; index of the body
# that carries it, counted through all worlds; the owner of faces on it that are not drawn.
RIGHT: Final = 3
DOWN: Final = 6
AHEAD: Final = 9
CARRIER: Final = 12
UNSEEN: Final = 13
CAMERA: Final = 14

# Lenses: pixels a unit of slope along rows and columns, nearest and farthest depth [m].
FX: Final = 0
FY: Final = 1
NEAR: Final = 2
FAR: Final = 3
LENS: Final = 4

_FLAT = 1e-12


@part
def backdrop(
    lens: Floats, camera: Floats, floor: Floats, sky: Floats, color: Bytes, inverse: Floats,
) -> None:  # fmt: skip
    """Fill a picture with the floor at height zero, and the sky."""
    height, width = inverse.shape
    for r in range(height):
        slope = camera[AHEAD + 2] + (r + 0.5 - height / 2.0) / lens[FY] * camera[DOWN + 2]
        near = 0.0 if camera[2] <= 0.0 else -slope / camera[2]
        seen = 1.0 / lens[FAR] < near <= 1.0 / lens[NEAR]
        paint = floor if seen else sky
        for c in range(width):
            inverse[r, c] = near if seen else 0.0
            for k in range(3):
                color[r, c, k] = paint[k]
            color[r, c, 3] = 255


@part
def seen_corners(
    face: Floats, pose: Floats, camera: Floats, lens: Floats, width: int, height: int,
    corners: Floats,
) -> bool:  # fmt: skip
    """Corners of a face of a body in the camera's frame; whether any of it may be in the picture."""
    tx, ty = width / 2.0 / lens[FX], height / 2.0 / lens[FY]
    before = beyond = left = right = above = below = 0
    for i in range(4):
        x, y = face[3 * i], face[3 * i + 1]
        dx = pose[X] + pose[COS] * x - pose[SIN] * y - camera[0]
        dy = pose[Y] + pose[SIN] * x + pose[COS] * y - camera[1]
        dz = pose[Z] + face[3 * i + 2] - camera[2]
        for k in range(3):
            at = 3 + 3 * k
            corners[i, k] = camera[at] * dx + camera[at + 1] * dy + camera[at + 2] * dz
        u, v, w = corners[i, 0], corners[i, 1], corners[i, 2]
        before += w < lens[NEAR]
        beyond += w > lens[FAR]
        left += u < -tx * w
        right += u > tx * w
        above += v < -ty * w
        below += v > ty * w
    return max(before, beyond, left, right, above, below) < 4


@part
def project(corners: Floats, lens: Floats, width: int, height: int, spots: Floats) -> int:
    """Cut off what is nearer than the lens shows; pixels of the rest, and how many corners."""
    count, near = 0, lens[NEAR]
    for i in range(4):
        j = (i + 1) % 4
        here, there = corners[i, 2], corners[j, 2]
        if here >= near:
            spots[count, 0] = width / 2.0 + lens[FX] * corners[i, 0] / here
            spots[count, 1] = height / 2.0 + lens[FY] * corners[i, 1] / here
            count += 1
        if (here >= near) != (there >= near):
            t = (near - here) / (there - here)
            x = corners[i, 0] + t * (corners[j, 0] - corners[i, 0])
            y = corners[i, 1] + t * (corners[j, 1] - corners[i, 1])
            spots[count, 0] = width / 2.0 + lens[FX] * x / near
            spots[count, 1] = height / 2.0 + lens[FY] * y / near
            count += 1
    return count


@part
def span(spots: Floats, count: int, middle: float) -> tuple[float, float]:
    """Where a convex polygon begins and ends in a row of pixels."""
    low, high = math.inf, -math.inf
    for i in range(count):
        j = i + 1 if i + 1 < count else 0
        v0, v1 = spots[i, 1], spots[j, 1]
        if (v0 <= middle) != (v1 <= middle):
            u = spots[i, 0] + (middle - v0) / (v1 - v0) * (spots[j, 0] - spots[i, 0])
            low, high = min(low, u), max(high, u)
    return low, high


@part
def fill(
    face: Floats, corners: Floats, lens: Floats, spots: Floats, count: int, color: Bytes,
    inverse: Floats,
) -> None:  # fmt: skip
    """Draw a projected face where nothing nearer is yet."""
    height, width = inverse.shape
    ax, ay, az = corners[1] - corners[0]
    bx, by, bz = corners[2] - corners[0]
    nx, ny, nz = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
    off = nx * corners[0, 0] + ny * corners[0, 1] + nz * corners[0, 2]
    if off >= -_FLAT:
        return  # seen from behind
    nx, ny, nz = nx / off, ny / off, nz / off
    top, bottom = math.inf, -math.inf
    for i in range(count):
        top, bottom = min(top, spots[i, 1]), max(bottom, spots[i, 1])
    least = 1.0 / lens[FAR]
    for r in range(math.ceil(max(top - 0.5, 0.0)), math.ceil(min(bottom - 0.5, float(height)))):
        low, high = span(spots, count, r + 0.5)
        if not low < high:
            continue
        row = nz + ny * (r + 0.5 - height / 2.0) / lens[FY]
        for c in range(math.ceil(max(low - 0.5, 0.0)), math.ceil(min(high - 0.5, float(width)))):
            near = row + nx * (c + 0.5 - width / 2.0) / lens[FX]
            if near > inverse[r, c] and near > least:
                inverse[r, c] = near
                for k in range(3):
                    color[r, c, k] = face[RED + k]


@kernel
def draw(
    first: int, last: int, cameras: Floats, lens: Floats, floor: Floats, sky: Floats,
    still: Floats, faces: Floats, spans: Indices, reach: Floats, rows: Floats, nbody: int,
    color: Bytes, inverse: Floats,
) -> None:  # fmt: skip
    """Draw the pictures of cameras first to last.

    Args:
        first: Of the cameras.
        last: Before it.
        cameras: Shape (n, CAMERA).
        lens: Of all of them, shape (LENS,).
        floor: Red, green and blue, 0 to 255.
        sky: Likewise.
        still: Faces in the world, shape (m, FACE).
        faces: Faces of the kinds of bodies in their frames.
        spans: First and last face of each body of a world, shape (nbody, 2).
        reach: Radius of each body about its origin [m].
        rows: Bodies of all worlds.
        nbody: Bodies in a world.
        color: Red, green, blue and 255, shape (n, height, width, 4), bytes.
        inverse: One over the depth [1/m], 0 where there is nothing, shape (n, height, width).
    """
    corners, spots, origin = np.empty((4, 3)), np.empty((8, 2)), np.zeros(8)
    origin[COS] = 1.0
    height, width = inverse.shape[1], inverse.shape[2]
    wide = math.sqrt((width / 2.0 / lens[FX]) ** 2 + (height / 2.0 / lens[FY]) ** 2)
    far = lens[FAR] * math.sqrt(1.0 + wide * wide)
    for n in range(first, last):
        camera = cameras[n]
        backdrop(lens, camera, floor, sky, color[n], inverse[n])
        for f in range(still.shape[0]):
            if seen_corners(still[f], origin, camera, lens, width, height, corners):
                count = project(corners, lens, width, height, spots)
                fill(still[f], corners, lens, spots, count, color[n], inverse[n])
        carrier = int(camera[CARRIER])
        start = carrier // nbody * nbody
        for b in range(start, start + nbody):
            body, away = b - start, far + reach[b - start]
            if (rows[b, X] - camera[0]) ** 2 + (rows[b, Y] - camera[1]) ** 2 > away * away:
                continue
            for f in range(spans[body, 0], spans[body, 1]):
                if b == carrier and faces[f, OWNER] == camera[UNSEEN]:
                    continue
                if seen_corners(faces[f], rows[b], camera, lens, width, height, corners):
                    count = project(corners, lens, width, height, spots)
                    fill(faces[f], corners, lens, spots, count, color[n], inverse[n])
