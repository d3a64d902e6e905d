# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="no-any-return"
"""Distances of points from triangles, in a tree of boxes."""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.geometry.ray_hits import TriangleRays

from gazelle.array_types import Floats

_WAITING = 128
"""Boxes that may wait for a point: more than there are levels in a tree."""
_FAR = cython.declare(cython.double, 1e300)
"""Square of the distance of nothing yet."""


@cython.final
@cython.cclass
class TriangleDistances:
    """Distances from triangles.

    Args:
        rays: Rays against the triangles, which have a tree of their boxes.
    """

    def __init__(self, rays: TriangleRays) -> None:
        self.tree = rays
        self.waiting, self.entry = np.zeros(_WAITING, np.int32), np.zeros(_WAITING)
        self.point = np.zeros(3)

    def of(self, points: Floats, enough: float = 0.0) -> Floats:
        """Return the distance of each point from the nearest triangle [m], shape (n,).

        Args:
            points: [m], shape (n, 3).
            enough: Distance up to which a triangle is near enough: no nearer one is looked for [m].
        """
        distance = np.zeros(len(points))
        places = cython.declare(cython.double[:, ::1], np.array(points, np.float64, order="C"))
        found = cython.declare(cython.double[::1], distance)
        least = cython.declare(cython.double, enough * enough)
        with cython.nogil:
            self.measure(places, least, found)
        return np.sqrt(distance)

    def measure(self, points: Floats, enough: float, squares: Floats) -> None:
        """Write the square of the distance of each point."""
        for n in range(points.shape[0]):
            for axis in range(3):
                self.point[axis] = points[n, axis]
            squares[n] = self.nearest(enough)

    def nearest(self, enough: float) -> float:
        """Return the square of the distance of the point from the nearest triangle."""
        best, node, count = _FAR, self.tree.root, 0
        while True:
            if node < 0:
                best = min(best, self.square_to(~node))
                if best <= enough:
                    return best
            else:
                one, other = self.tree.children[node, 0], self.tree.children[node, 1]
                near, far = self.square_to_box(node, 0), self.square_to_box(node, 1)
                if far < near:
                    one, other, near, far = other, one, far, near
                if far < best:
                    self.waiting[count], self.entry[count] = other, far
                    count += 1
                if near < best:
                    node = one
                    continue
            while count > 0 and self.entry[count - 1] >= best:
                count -= 1
            if count == 0:
                return best
            count -= 1
            node = self.waiting[count]

    def square_to_box(self, node: int, side: int) -> float:
        """Return the square of the distance of the point from the box of one below a node."""
        total = 0.0
        for axis in range(3):
            below = self.tree.bounds[node, axis, side] - self.point[axis]
            above = self.point[axis] - self.tree.bounds[node, axis, side + 2]
            away = max(below, above, 0.0)
            total += away * away
        return total

    def square_to(self, face: int) -> float:
        """Return the square of the distance of the point from a triangle.

        It is that from the plane if the foot there is in the triangle, else from an edge.
        """
        t, p = self.tree.triangles, self.point
        ux, uy, uz = t[face, 3], t[face, 4], t[face, 5]
        vx, vy, vz = t[face, 6], t[face, 7], t[face, 8]
        x, y, z = p[0] - t[face, 0], p[1] - t[face, 1], p[2] - t[face, 2]
        uu, uv, vv = (
            ux * ux + uy * uy + uz * uz,
            ux * vx + uy * vy + uz * vz,
            vx * vx + vy * vy + vz * vz,
        )
        pu, pv = x * ux + y * uy + z * uz, x * vx + y * vy + z * vz
        area, pp = uu * vv - uv * uv, x * x + y * y + z * z
        a, b = vv * pu - uv * pv, uu * pv - uv * pu
        if area > 0.0 and a >= 0.0 and b >= 0.0 and a + b <= area:
            nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
            height = x * nx + y * ny + z * nz
            return height * height / area
        best = square_to_line(pp, pu, uu)
        best = min(best, square_to_line(pp, pv, vv))
        # From the second corner on, along the third edge.
        far = pp - 2.0 * pu + uu
        return min(best, square_to_line(far, pv - pu - uv + uu, uu - 2.0 * uv + vv))


def square_to_line(square: float, along: float, length: float) -> float:
    """Return the square of the distance of a point from a line between two places.

    Args:
        square: Of the distance from the first place.
        along: Product of the way from there to the point and the line.
        length: Square of the length of the line.
    """
    if along <= 0.0 or length <= 0.0:
        return square
    if along >= length:
        return max(square - 2.0 * along + length, 0.0)
    return max(square - along * along / length, 0.0)
