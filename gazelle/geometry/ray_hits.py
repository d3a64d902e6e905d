# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="no-any-return"
"""Rays against triangles, in a tree of boxes."""

from __future__ import annotations

import cython
import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats, Indices
from gazelle.native.box_trees import BoxTree

_START = 1e-5
"""Distance from its origin at which a ray begins, as a share of the size."""
_ASIDE = np.array([0.613e-6, 0.371e-6, 0.697e-6])
"""Offset of rays, likewise: what meets an edge exactly may pass between its two triangles."""
_MARGIN = 1e-9
"""Width of boxes beyond their triangles, likewise: rounding must not miss what is flat."""
_WAITING = 128
"""Boxes that may wait for a ray: more than there are levels in a tree."""
_TIE = 1e-8
"""Difference of distances that counts as none, likewise."""
_STEEP = cython.declare(cython.double, 1e300)
"""Inverse of what is nearly 0."""
_FAR = cython.declare(cython.double, 1e300)
"""Distance of nothing yet."""
_ENDLESS = cython.declare(cython.double, np.inf)


@cython.final
@cython.cclass
class TriangleRays:
    """Rays against triangles, which are met from both sides.

    Args:
        vertices: [m], shape (n, 3).
        faces: Corners, shape (m, 3), at least one.
        size: Diagonal of the box around them [m].
    """

    def __init__(self, vertices: Floats, faces: Indices, size: float) -> None:
        corners = vertices[faces]
        low, high = corners.min(axis=1), corners.max(axis=1)
        half = (high - low) / 2.0 + _MARGIN * size
        tree = BoxTree(np.concatenate([(low + high) / 2.0, half], axis=1))
        middle, half = tree.bounds[:, :3], tree.bounds[:, 3:]
        below = tree.children
        # Of both nodes below each, by axis: the lower sides, then the upper ones.
        sides = np.stack([(middle - half)[below], (middle + half)[below]], axis=1)
        self.bounds = np.ascontiguousarray(np.moveaxis(sides, 3, 1).reshape(-1, 3, 4))
        self.children = np.where(tree.leaf[below] >= 0, ~tree.leaf[below], below)
        self.root = ~0 if len(faces) == 1 else 0
        edges = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        self.triangles = np.concatenate([corners[:, 0], *edges], axis=1)
        self.size, self.tie = size, _TIE * size
        self.waiting, self.entry = np.zeros(_WAITING, np.int32), np.zeros(_WAITING)
        self.ray = np.zeros(9)  # origin, direction, and the inverse of that

    def first_hits(self, origins: Floats, directions: Floats) -> tuple[Floats, Bools]:
        """Return distance along rays to the first triangle, and whether they come from behind it.

        Args:
            origins: [m], shape (n, 3); what is nearer than a hundred-thousandth of the size is
                not met.
            directions: Unit vectors, shape (n, 3).

        Returns:
            Distances [m], infinite where there is nothing, and whether the triangle looks away,
            both of shape (n,).
        """
        start = origins + self.size * (_START * directions + _ASIDE)
        distance, within = np.full(len(start), np.inf), np.zeros(len(start), np.uint8)
        origin = cython.declare(cython.double[:, ::1], np.ascontiguousarray(start))
        way = cython.declare(cython.double[:, ::1], np.array(directions, order="C"))
        reach = cython.declare(cython.double[::1], distance)
        behind = cython.declare(cython.uchar[::1], within)
        with cython.nogil:
            self.cast(origin, way, reach, behind)
        return distance + _START * self.size, within.astype(np.bool_)

    def cast(
        self, origins: Floats, directions: Floats, distance: Floats, within: NDArray[np.uint8]
    ) -> None:
        """Write the distance of the first triangle along each ray, and whether it looks away."""
        ray = self.ray
        for n in range(origins.shape[0]):
            for axis in range(3):
                way = directions[n, axis]
                ray[axis], ray[axis + 3] = origins[n, axis], way
                ray[axis + 6] = 1.0 / way if way > 1e-300 or way < -1e-300 else _STEEP
            if self.find_first():
                distance[n], within[n] = self.nearest, self.leaves

    def find_first(self) -> bool:
        """Find the first triangle that the ray meets; False if there is none.

        Its distance is ``nearest``, and ``leaves`` whether it looks away. Where a body begins at
        another one's end, it is that end.
        """
        self.nearest, self.leaves = _FAR, 0
        node, count, found = self.root, 0, False
        while True:
            if node < 0:
                found |= self.meets(~node)
            else:
                one, other = self.children[node, 0], self.children[node, 1]
                near, far = self.enters(node, 0), self.enters(node, 1)
                if far < near:
                    one, other, near, far = other, one, far, near
                if far <= self.nearest + self.tie:
                    self.waiting[count], self.entry[count] = other, far
                    count += 1
                if near <= self.nearest + self.tie:
                    node = one
                    continue
            while count > 0 and self.entry[count - 1] > self.nearest + self.tie:
                count -= 1
            if count == 0:
                return found
            count -= 1
            node = self.waiting[count]

    def enters(self, node: int, side: int) -> float:
        """Return where the ray enters the box of one below a node; endless if it does not."""
        begin, end = 0.0, _ENDLESS
        for axis in range(3):
            inverse, place = self.ray[axis + 6], self.ray[axis]
            turned = 2 if inverse < 0.0 else 0
            one = (self.bounds[node, axis, side + turned] - place) * inverse
            other = (self.bounds[node, axis, side + 2 - turned] - place) * inverse
            begin = max(begin, one)
            end = min(end, other)
        return begin if begin <= end else _ENDLESS

    def meets(self, face: int) -> bool:
        """Return whether a triangle is met before the nearest so far; it is the nearest then.

        After Möller and Trumbore, "Fast, minimum storage ray-triangle intersection", Journal of
        Graphics Tools 2 (1997).
        """
        ray, t = self.ray, self.triangles
        px = ray[4] * t[face, 8] - ray[5] * t[face, 7]
        py = ray[5] * t[face, 6] - ray[3] * t[face, 8]
        pz = ray[3] * t[face, 7] - ray[4] * t[face, 6]
        volume = t[face, 3] * px + t[face, 4] * py + t[face, 5] * pz
        if volume == 0.0:
            return False
        sx, sy, sz = ray[0] - t[face, 0], ray[1] - t[face, 1], ray[2] - t[face, 2]
        u = (sx * px + sy * py + sz * pz) / volume
        if u < 0.0 or u > 1.0:
            return False
        qx = sy * t[face, 5] - sz * t[face, 4]
        qy = sz * t[face, 3] - sx * t[face, 5]
        qz = sx * t[face, 4] - sy * t[face, 3]
        v = (ray[3] * qx + ray[4] * qy + ray[5] * qz) / volume
        if v < 0.0 or u + v > 1.0:
            return False
        away = (t[face, 6] * qx + t[face, 7] * qy + t[face, 8] * qz) / volume
        if away < 0.0 or away > self.nearest + (self.tie if volume < 0.0 else -self.tie):
            return False
        self.leaves = volume < 0.0
        self.nearest = min(self.nearest, away)
        return True
