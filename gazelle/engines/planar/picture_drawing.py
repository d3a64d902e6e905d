# cython: infer_types=True, annotation_typing=False
"""Pictures of extruded outlines: flat faces drawn into pixels by their inverse depths.

The inverse of the depth along the optical axis is linear in a picture (the depth buffer of
any graphics card works so), which makes every covered pixel exact. A pixel is what its middle
sees.
"""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.engines.planar.columns import COS, SIN, X, Y, Z
from cython.cimports.gazelle.engines.planar.picture_columns import (
    AHEAD,
    CARRIER,
    DOWN,
    FARTHEST,
    FX,
    FY,
    NEAREST,
    OWNER,
    RED,
    RIGHT,
    UNSEEN,
)  # fmt: skip
from cython.cimports.libc.math import ceil, sqrt

from gazelle.array_types import Bytes, Floats, Ints64

INF = cython.declare(cython.double, float("inf"))
FLAT = cython.declare(cython.double, 1e-12)  # faces seen from their edge are less [m^3]


class ColoredFaces:
    """What worlds look like to cameras.

    Args:
        faces: As ``picture_columns.RED`` and what follows say, shape (n, FACE): of what stands
            still, in the world; then of bodies, in their frames.
        still: How many of them are of what stands still.
        spans: Of each body of a world the first face and the one after its last, shape (nbody, 2).
        reach: Radius of each body about its origin [m], shape (nbody,).
        floor: Red, green and blue of the ground at height zero, 0 to 255.
        sky: Likewise, of all else.
    """

    def __init__(
        self, faces: Floats, still: int, spans: Ints64, reach: Floats, floor: Floats, sky: Floats
    ) -> None:
        self.faces, self.still, self.spans, self.reach = faces, still, spans, reach
        self.floor, self.sky = floor, sky


class PictureDrawing:
    """Pictures of some cameras, and what one thread needs to draw them.

    Args:
        scene: What there is to be seen.
        rows: Bodies of all worlds, shape (nworld * nbody, columns.BODY).
        lens: Of all cameras, as ``picture_columns.FX`` and what follows say, shape (LENS,).
        cameras: As ``picture_columns.RIGHT`` and what follows say, shape (n, CAMERA).
        color: Red, green, blue and 255 come out, shape (n, height, width, 4).
        inverse: One over the depth comes out [1/m], 0 where there is nothing, shape
            (n, height, width).
    """

    def __init__(
        self,
        scene: ColoredFaces,
        rows: Floats,
        lens: Floats,
        cameras: Floats,
        color: Bytes,
        inverse: Floats,
    ) -> None:
        self.scene, self.rows, self.cameras = scene, rows, cameras
        self.color, self.inverse = color, inverse
        self.height, self.width = inverse.shape[1], inverse.shape[2]
        self.fx, self.fy = lens[FX], lens[FY]
        self.near, self.far = lens[NEAREST], lens[FARTHEST]
        # Corners of a face in the camera's frame [m], and of what is seen of it [pixel].
        self.corners, self.spots = np.empty((4, 3)), np.empty((8, 2))
        self.paint = np.empty(3)  # red, green and blue of what is drawn
        wide, high = self.width / 2.0 / self.fx, self.height / 2.0 / self.fy
        aside = sqrt(wide * wide + high * high)
        self.reach = self.far * sqrt(1.0 + aside * aside)

    def draw(self, first: int, last: int) -> None:
        """Draw the pictures of cameras first to last, without the interpreter's lock."""
        begin, end = (
            cython.declare(cython.Py_ssize_t, first),
            cython.declare(cython.Py_ssize_t, last),
        )
        with cython.nogil:
            for n in range(begin, end):
                self.draw_one(n)

    def draw_one(self, n: int) -> None:
        """Draw the picture of camera n: what is behind, what stands still, and bodies."""
        self.draw_backdrop(n)
        self.x, self.y, self.z, self.cos, self.sin = 0.0, 0.0, 0.0, 1.0, 0.0
        self.draw_faces(n, 0, self.scene.still, False)
        carrier = cython.cast(cython.Py_ssize_t, self.cameras[n, CARRIER])
        nbody = self.scene.spans.shape[0]
        start = carrier // nbody * nbody
        for k in range(nbody):
            b = start + k
            self.x, self.y, self.z = self.rows[b, X], self.rows[b, Y], self.rows[b, Z]
            self.cos, self.sin = self.rows[b, COS], self.rows[b, SIN]
            dx, dy = self.x - self.cameras[n, 0], self.y - self.cameras[n, 1]
            away = self.reach + self.scene.reach[k]
            if dx * dx + dy * dy <= away * away:
                self.draw_faces(n, self.scene.spans[k, 0], self.scene.spans[k, 1], b == carrier)

    def draw_backdrop(self, n: int) -> None:
        """Fill a picture with the floor at height zero, and the sky."""
        color, inverse, high = self.color, self.inverse, self.cameras[n, 2]
        for r in range(self.height):
            aside = (r + 0.5 - self.height / 2.0) / self.fy
            slope = self.cameras[n, AHEAD + 2] + aside * self.cameras[n, DOWN + 2]
            near = 0.0 if high <= 0.0 else -slope / high
            seen = 1.0 / self.far < near <= 1.0 / self.near
            near = near if seen else 0.0
            for k in range(3):
                self.paint[k] = self.scene.floor[k] if seen else self.scene.sky[k]
            red, green, blue = byte(self.paint[0]), byte(self.paint[1]), byte(self.paint[2])
            for c in range(inverse.shape[2]):
                inverse[n, r, c] = near
                color[n, r, c, 0], color[n, r, c, 1] = red, green
                color[n, r, c, 2], color[n, r, c, 3] = blue, 255

    def draw_faces(self, n: int, first: int, last: int, own: bool) -> None:  # noqa: FBT001
        """Draw some faces in the frame that is placed.

        Args:
            n: Of the camera.
            first: Of the faces.
            last: The one after the last.
            own: Whether they are on the body that carries the camera, which may not see some.
        """
        for f in range(first, last):
            if own and self.scene.faces[f, OWNER] == self.cameras[n, UNSEEN]:
                continue
            if self.is_in_view(n, f):
                self.fill(n, f, self.project())

    def is_in_view(self, n: int, f: int) -> bool:
        """Find the corners of a face in the camera's frame; whether any of it may be seen."""
        tx, ty = self.width / 2.0 / self.fx, self.height / 2.0 / self.fy
        before = beyond = left = right = above = below = 0
        for i in range(4):
            x, y = self.scene.faces[f, 3 * i], self.scene.faces[f, 3 * i + 1]
            dx = self.x + self.cos * x - self.sin * y - self.cameras[n, 0]
            dy = self.y + self.sin * x + self.cos * y - self.cameras[n, 1]
            dz = self.z + self.scene.faces[f, 3 * i + 2] - self.cameras[n, 2]
            for k in range(3):
                at = RIGHT + 3 * k
                self.corners[i, k] = (
                    self.cameras[n, at] * dx
                    + self.cameras[n, at + 1] * dy
                    + self.cameras[n, at + 2] * dz
                )
            u, v, w = self.corners[i, 0], self.corners[i, 1], self.corners[i, 2]
            before += w < self.near
            beyond += w > self.far
            left += u < -tx * w
            right += u > tx * w
            above += v < -ty * w
            below += v > ty * w
        return max(before, beyond, left, right, above, below) < 4

    def project(self) -> int:
        """Cut off what is nearer than the lens shows; find pixels of the rest.

        Returns:
            How many corners that has.
        """
        count = 0
        for i in range(4):
            j = (i + 1) % 4
            here, there = self.corners[i, 2], self.corners[j, 2]
            before, after = here < self.near, there < self.near
            if not before:
                self.put_spot(count, self.corners[i, 0], self.corners[i, 1], here)
                count += 1
            if before != after:
                t = (self.near - here) / (there - here)
                x = self.corners[i, 0] + t * (self.corners[j, 0] - self.corners[i, 0])
                y = self.corners[i, 1] + t * (self.corners[j, 1] - self.corners[i, 1])
                self.put_spot(count, x, y, self.near)
                count += 1
        return count

    def put_spot(self, count: int, x: float, y: float, depth: float) -> None:
        """Write down where in the picture a place is that the camera has in its frame."""
        self.spots[count, 0] = self.width / 2.0 + self.fx * x / depth
        self.spots[count, 1] = self.height / 2.0 + self.fy * y / depth

    def row_of_polygon(self, count: int, middle: float) -> tuple[float, float]:
        """Where the polygon of the first spots begins and ends in a row of pixels."""
        low, high = INF, -INF
        for i in range(count):
            j = i + 1 if i + 1 < count else 0
            v0, v1 = self.spots[i, 1], self.spots[j, 1]
            if (v0 <= middle) != (v1 <= middle):
                share = (middle - v0) / (v1 - v0)
                u = self.spots[i, 0] + share * (self.spots[j, 0] - self.spots[i, 0])
                low, high = min(low, u), max(high, u)
        return low, high

    def fill(self, n: int, f: int, count: int) -> None:
        """Draw a face, which has so many spots, where nothing nearer is yet."""
        x, y, z = self.corners[0, 0], self.corners[0, 1], self.corners[0, 2]
        # Across its diagonals, as three of four corners may be on a line.
        ax, ay, az = self.corners[2, 0] - x, self.corners[2, 1] - y, self.corners[2, 2] - z
        bx, by = self.corners[3, 0] - self.corners[1, 0], self.corners[3, 1] - self.corners[1, 1]
        bz = self.corners[3, 2] - self.corners[1, 2]
        nx, ny, nz = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
        off = nx * x + ny * y + nz * z
        if off >= -FLAT:
            return  # seen from behind
        nx, ny, nz = nx / off, ny / off, nz / off
        top, bottom = INF, -INF
        for i in range(count):
            top, bottom = min(top, self.spots[i, 1]), max(bottom, self.spots[i, 1])
        for k in range(3):
            self.paint[k] = self.scene.faces[f, RED + k]
        for r in range(first_middle(top, self.height), first_middle(bottom, self.height)):
            low, high = self.row_of_polygon(count, r + 0.5)
            if low < high:
                row = nz + ny * (r + 0.5 - self.height / 2.0) / self.fy
                self.fill_row(
                    n, r, first_middle(low, self.width), first_middle(high, self.width), row, nx
                )

    def fill_row(self, n: int, r: int, first: int, last: int, row: float, slope: float) -> None:
        """Paint pixels first to last of a row where nothing nearer is yet.

        The inverse depth is ``row`` on the axis, and ``slope`` more for each unit to the right.
        """
        color, inverse, middle, fx = self.color, self.inverse, self.width / 2.0, self.fx
        red, green, blue = byte(self.paint[0]), byte(self.paint[1]), byte(self.paint[2])
        least = 1.0 / self.far
        for c in range(first, last):
            near = row + slope * (c + 0.5 - middle) / fx
            if near > inverse[n, r, c] and near > least:
                inverse[n, r, c] = near
                color[n, r, c, 0], color[n, r, c, 1], color[n, r, c, 2] = red, green, blue


def byte(shade: float) -> int:
    """A share of a colour, 0 to 255, as pictures hold it."""
    return cython.cast(cython.uchar, shade)  # type: ignore[no-any-return]


def first_middle(edge: float, most: int) -> int:
    """The first of so many pixels whose middle is not before an edge."""
    inside = min(max(edge - 0.5, 0.0), 1.0 * most)
    return cython.cast(cython.Py_ssize_t, ceil(inside))  # type: ignore[no-any-return]
