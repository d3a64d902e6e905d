# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="no-any-return"
"""The rims of polygons on a surface, in their planes: hulls, and how deep notches are."""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.libc.math import atan2, fabs, hypot, sqrt

from gazelle.array_types import Bools, Indices
from gazelle.geometry.surface import WeldedSurface

_ROUNDING = cython.declare(cython.double, 1e-9)
"""Share of the squared length at which a turn counts as none."""
_FULL = cython.declare(cython.double, 1e-6)
"""Tolerance of the sum of a convex polygon's turns about one full turn [rad]."""
_TURN = cython.declare(cython.double, 6.283185307179586)


@cython.final
@cython.cclass
class PolygonRings:
    """The half-edges around polygons, at first triangles, and the corners of one in its plane.

    Args:
        surface: Surface of the triangles.
    """

    def __init__(self, surface: WeldedSurface) -> None:
        count = len(surface.faces)
        rows = np.arange(3 * count).reshape(-1, 3)
        self.points = np.ascontiguousarray(surface.vertices, np.float64)
        self.normals = np.ascontiguousarray(surface.normals, np.float64)
        self.tail = np.ascontiguousarray(surface.faces.ravel(), np.intp)
        self.after = np.roll(rows, -1, axis=1).ravel()
        self.before = np.roll(rows, 1, axis=1).ravel()
        self.start = 3 * np.arange(count)
        self.place = np.zeros((3 * count, 2))
        self.edge, self.hull = np.zeros((2, 3 * count), np.intp)
        self.inside = np.zeros(3 * count, np.uint8)
        self.axes = np.zeros((2, 3))
        self.count = self.kept = 0

    def around(self, faces: Indices, notched: Bools) -> tuple[Indices, Indices]:
        """Return the corners of polygons one after the other, and how many each has.

        Args:
            faces: Polygons.
            notched: Whether each has notches, whose corners are left out, shape (n,).
        """
        polygons = cython.declare(cython.Py_ssize_t[::1], np.ascontiguousarray(faces, np.intp))
        uneven = cython.declare(cython.uchar[::1], notched.view(np.uint8))
        corners, counts = np.empty(len(self.tail), np.intp), np.empty(len(faces), np.intp)
        found = cython.declare(cython.Py_ssize_t[::1], corners)
        sizes = cython.declare(cython.Py_ssize_t[::1], counts)
        with cython.nogil:
            total = self.write(polygons, uneven, found, sizes)
        return corners[:total], counts

    def write(self, faces: Indices, notched: Bools, corners: Indices, sizes: Indices) -> int:
        """Write the corners of polygons and how many each has; returns how many all have."""
        total = 0
        for row in range(faces.shape[0]):
            first = total
            if notched[row]:
                self.begin(faces[row])
                self.put(self.start[faces[row]])
                self.add(self.after[self.start[faces[row]]], self.start[faces[row]])
                self.find_hull()
                for k in range(self.kept):
                    corners[total] = self.tail[self.edge[self.hull[k]]]
                    total += 1
            else:
                edge = self.start[faces[row]]
                while True:
                    corners[total] = self.tail[edge]
                    total += 1
                    edge = self.after[edge]
                    if edge == self.start[faces[row]]:
                        break
            sizes[row] = total - first
        return total

    def begin(self, face: int) -> None:
        """Remove all corners, and measure in the plane of a triangle from now on."""
        self.count = axis = 0
        for other in range(1, 3):
            if fabs(self.normals[face, other]) < fabs(self.normals[face, axis]):
                axis = other
        x, y, z = self.normals[face, 0], self.normals[face, 1], self.normals[face, 2]
        u, v = (axis + 1) % 3, (axis + 2) % 3
        self.axes[0, axis] = 0.0
        self.axes[0, u], self.axes[0, v] = -self.normals[face, v], self.normals[face, u]
        a, b, c = self.axes[0, 0], self.axes[0, 1], self.axes[0, 2]
        length = sqrt(a * a + b * b + c * c)
        a, b, c = a / length, b / length, c / length
        self.axes[0, 0], self.axes[0, 1], self.axes[0, 2] = a, b, c
        self.axes[1, 0] = y * c - z * b
        self.axes[1, 1] = z * a - x * c
        self.axes[1, 2] = x * b - y * a

    def add(self, edge: int, end: int) -> None:
        """Add the corners at half-edges from one on, without the last."""
        while edge != end:
            self.put(edge)
            edge = self.after[edge]

    def put(self, edge: int) -> None:
        """Add the corner at a half-edge."""
        point, x, y = self.tail[edge], 0.0, 0.0
        for axis in range(3):
            x += self.points[point, axis] * self.axes[0, axis]
            y += self.points[point, axis] * self.axes[1, axis]
        self.place[self.count, 0], self.place[self.count, 1] = x, y
        self.edge[self.count] = edge
        self.count += 1

    def find_hull(self) -> None:
        """Find the corners of the hull.

        A corner that does not stand out of its polygon is not on the hull: such corners are left
        out until there is none. That gives hulls where rims do not cross themselves.
        """
        self.kept = self.count
        for k in range(self.count):
            self.hull[k] = k
        while True:
            kept = 0
            for k in range(self.kept):
                turn, squares = self.turn_at(k), self.squares
                self.inside[k] = turn <= _ROUNDING * squares
            for k in range(self.kept):
                if not self.inside[k]:
                    self.hull[kept] = self.hull[k]
                    kept += 1
            if kept == self.kept:
                return
            self.kept = kept

    def turn_at(self, k: int) -> float:
        """Return the cross product of the sides at a corner of the hull; writes the squares and along."""
        here = self.hull[k]
        before = self.hull[k - 1 if k > 0 else self.kept - 1]
        after = self.hull[k + 1 if k + 1 < self.kept else 0]
        ux = self.place[here, 0] - self.place[before, 0]
        uy = self.place[here, 1] - self.place[before, 1]
        vx = self.place[after, 0] - self.place[here, 0]
        vy = self.place[after, 1] - self.place[here, 1]
        self.squares = (ux * ux + uy * uy) + (vx * vx + vy * vy)
        self.along = ux * vx + uy * vy
        return ux * vy - uy * vx

    def turns_once(self) -> bool:
        """Return whether the hull has at least three corners and goes around once."""
        if self.kept < 3:
            return False
        whole = 0.0
        for k in range(self.kept):
            turn = self.turn_at(k)
            whole += atan2(turn, self.along)
        return fabs(whole - _TURN) < _FULL

    def deepest(self) -> float:
        """Return the depth of the deepest corner off the hull, which has corners [m].

        Deep is what is far from the side of the hull across its own notch: in a thin ring that is
        nearly closed all corners are close to some side.
        """
        deepest, side = 0.0, self.kept - 1
        for k in range(self.count):
            after = side + 1 if side + 1 < self.kept else 0
            if self.hull[after] == k:
                side = after
                continue
            one, two = self.hull[side], self.hull[after]
            x = self.place[two, 0] - self.place[one, 0]
            y = self.place[two, 1] - self.place[one, 1]
            height = x * (self.place[k, 1] - self.place[one, 1])
            height = height - y * (self.place[k, 0] - self.place[one, 0])
            height = height / hypot(x, y)
            deepest = max(deepest, height)
        return deepest
