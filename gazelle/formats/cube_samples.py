# cython: infer_types=True, annotation_typing=False
"""Places all over triangles, sorted into the cubes of a grid."""

from __future__ import annotations

import cython
import numpy as np

from gazelle.array_types import Bools, Floats, Indices


@cython.cclass
class CubeSampler:
    """Takes places all over triangles into a grid of cubes, the first of each cube.

    Args:
        low: Corner of the grid [m], shape (3,).
        side: Of a cube [m].
        shape: Cubes along x, y and z.
        most: Cubes that places may be in.

    Attributes:
        count: How many places were taken.
    """

    def __init__(self, low: Floats, side: float, shape: tuple[int, int, int], most: int) -> None:
        self.low, self.side = np.array(low, np.float64), side
        self.rows, self.columns = shape[1], shape[2]
        self.full = np.zeros(shape[0] * shape[1] * shape[2], np.uint8)
        self.points = np.empty((most, 3))
        self.cubes = np.empty(most, np.int64)
        self.count = 0

    def take(self, corners: Floats, along: Indices, aside: Indices) -> None:
        """Take places of triangles, a step of each side after the other.

        Args:
            corners: [m], shape (n, 3, 3).
            along: Steps from the first corner to the second, shape (n,); 0 takes only that corner.
            aside: Steps from there to the third, shape (n,).
        """
        triangles = cython.declare(cython.double[:, :, ::1], corners)
        wide = cython.declare(cython.longlong[::1], along)
        high = cython.declare(cython.longlong[::1], aside)
        with cython.nogil:
            self.walk(triangles, wide, high)

    def found(self) -> tuple[Floats, Indices, Bools]:
        """The places [m], shape (k, 3), their cubes, and which cubes have one."""
        cubes = np.asarray(self.cubes)[: self.count]
        return np.asarray(self.points)[: self.count], cubes, np.asarray(self.full).view(np.bool_)

    def walk(self, corners: Floats, along: Indices, aside: Indices) -> None:
        """``take`` without Python."""
        for n in range(corners.shape[0]):
            wide, high = along[n], aside[n]
            if wide == 0:
                self.put(corners[n, 0, 0], corners[n, 0, 1], corners[n, 0, 2])
                continue
            for i in range(wide + 1):
                s = cython.cast(cython.double, i) / wide
                for j in range(high + 1):
                    third = cython.cast(cython.double, j) / high
                    second = (1.0 - third) * s
                    first = 1.0 - second - third
                    self.put(
                        first * corners[n, 0, 0]
                        + second * corners[n, 1, 0]
                        + third * corners[n, 2, 0],
                        first * corners[n, 0, 1]
                        + second * corners[n, 1, 1]
                        + third * corners[n, 2, 1],
                        first * corners[n, 0, 2]
                        + second * corners[n, 1, 2]
                        + third * corners[n, 2, 2],
                    )

    def put(self, x: float, y: float, z: float) -> None:
        """Take a place if it is the first of its cube."""
        i = cython.cast(cython.longlong, (x - self.low[0]) / self.side)
        j = cython.cast(cython.longlong, (y - self.low[1]) / self.side)
        k = cython.cast(cython.longlong, (z - self.low[2]) / self.side)
        cube = (i * self.rows + j) * self.columns + k
        if self.full[cube] == 0:
            self.full[cube] = 1
            self.points[self.count, 0] = x
            self.points[self.count, 1] = y
            self.points[self.count, 2] = z
            self.cubes[self.count] = cube
            self.count += 1
