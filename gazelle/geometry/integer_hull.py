# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="no-any-return"
"""Convex hulls of points on a grid of integers, where no test is ever rounded.

Quickhull: Barber, Dobkin, Huhdanpaa, "The Quickhull algorithm for convex hulls", ACM
Transactions on Mathematical Software 22 (1996). Points are put on a grid of 2^19 steps along the
longest side of their box. There the sign of a volume is exact in 64 bits: points that lie in a
plane are known to, and the faces that a point sees are always one patch with one rim. So nothing
has to be shaken or merged; a corner is off by the grid, a millionth of the size.
"""

from __future__ import annotations

import cython
import numpy as np

from gazelle.array_types import Floats, Indices, Ints32

STEPS = cython.declare(cython.double, 2.0**19 - 1.0)


@cython.final
@cython.cclass
class HullBuilder:
    """Room to make hulls in, one after the other.

    Args:
        most: Points that a hull may have to be made of.

    Attributes:
        scale: Steps of the grid a unit of length.
        faces: Number of used places for faces; those whose first corner is -1 are free.
    """

    def __init__(self, most: int) -> None:
        room = 2 * most + 8
        self.most = most
        self.place = np.zeros((most, 3), np.int64)
        self.low = np.zeros(3)
        self.corner = np.zeros((room, 3), np.int32)
        self.across = np.zeros((room, 3), np.int32)  # the face beyond the edge from corner i on
        self.normal = np.zeros((room, 3), np.int64)
        self.first = np.zeros(room, np.int32)  # of the points outside of a face
        self.seen = np.zeros(room, np.int32)  # the last point that saw a face
        self.waits = np.zeros(room, np.int32)  # whether a face is in ``queue``
        self.queue = np.zeros(room, np.int32)
        self.patch = np.zeros(room, np.int32)  # faces that the new corner sees
        self.rim = np.zeros((room, 3), np.int32)  # edges around those: tail, head, face beyond
        self.free = np.zeros(room, np.int32)
        self.after = np.zeros(most, np.int32)  # the next point outside of the same face
        self.begins = np.zeros(most, np.int32)  # the new face that begins at a corner

    def hull(self, points: Floats) -> Indices | None:
        """Return faces of the hull of points.

        Args:
            points: Finite [m], shape (n, 3); not more than there is room for.

        Returns:
            Rows of the points, counter-clockwise from outside, shape (m, 3); None if the points
            lie in a plane.

        Raises:
            ValueError: There are too many points.
        """
        if len(points) > self.most:
            raise ValueError(f"there is room for {self.most} points, not for {len(points)}")
        cloud = cython.declare(cython.double[:, ::1], np.array(points, np.float64, order="C"))
        with cython.nogil:
            found = self.build(cloud)
        if not found:
            return None
        corners = np.asarray(self.corner)[: self.faces]
        rows: Indices = corners[corners[:, 0] >= 0].astype(np.intp)
        return rows

    def normals(self) -> Floats:
        """Return unit vectors out of the faces of the last hull, shape (m, 3)."""
        rows = np.asarray(self.corner)[: self.faces, 0] >= 0
        across = np.asarray(self.normal)[: self.faces][rows].astype(np.float64)
        normals: Floats = across / np.linalg.norm(across, axis=1)[:, None]
        return normals

    def build(self, points: Floats) -> bool:
        """Make the hull of points, shape (n, 3); False if they lie in a plane."""
        count = points.shape[0]
        self.put_on_grid(points)
        if not self.begin(count):
            return False
        while self.waiting > 0:
            self.waiting -= 1
            face = self.queue[self.waiting]
            self.waits[face] = 0
            if self.corner[face, 0] >= 0 and self.first[face] >= 0:
                self.add(self.farthest(face), face)
        return True

    def write_corners(self, count: int, rows: Ints32) -> int:
        """Write the rows of the points that are corners of the last hull, rising.

        Args:
            count: Points that it was built of.
            rows: Room for the rows, shape (most,).

        Returns:
            The number of corners.
        """
        used, found = self.after, 0
        for i in range(count):
            used[i] = 0
        for face in range(self.faces):
            if self.corner[face, 0] >= 0:
                for i in range(3):
                    used[self.corner[face, i]] = 1
        for i in range(count):
            if used[i]:
                rows[found] = i
                found += 1
        return found

    def put_on_grid(self, points: Floats) -> None:
        """Store the points in steps from the least corner of their box."""
        count = points.shape[0]
        span = 0.0
        for axis in range(3):
            low = high = points[0, axis]
            for i in range(1, count):
                low = min(low, points[i, axis])
                high = max(high, points[i, axis])
            self.low[axis] = low
            span = max(span, high - low)
        self.scale = STEPS / span if span > 0.0 else 0.0
        for i in range(count):
            for axis in range(3):
                steps = (points[i, axis] - self.low[axis]) * self.scale + 0.5
                self.place[i, axis] = cython.cast(cython.longlong, steps)

    def height(self, face: int, x: int, y: int, z: int) -> int:
        """Return the distance of a position in front of a face, in steps times twice its area."""
        a = self.corner[face, 0]
        return (
            self.normal[face, 0] * (x - self.place[a, 0])
            + self.normal[face, 1] * (y - self.place[a, 1])
            + self.normal[face, 2] * (z - self.place[a, 2])
        )

    def sees(self, point: int, face: int) -> bool:
        """Return whether a point is in front of a face."""
        place = self.place
        return self.height(face, place[point, 0], place[point, 1], place[point, 2]) > 0

    def holds(self, x: float, y: float, z: float, last: int) -> int:
        """Return -1 if a place is in the hull, else a face that it is in front of.

        Args:
            x: [m].
            y: [m].
            z: [m].
            last: Face that is asked first, as it decided a place nearby.
        """
        x, y, z = (
            (x - self.low[0]) * self.scale,
            (y - self.low[1]) * self.scale,
            (z - self.low[2]) * self.scale,
        )
        if last >= 0 and self.is_before(last, x, y, z):
            return last
        for face in range(self.faces):
            if self.corner[face, 0] >= 0 and self.is_before(face, x, y, z):
                return face
        return -1

    def is_before(self, face: int, x: float, y: float, z: float) -> bool:
        """Return whether a position between the grid's points is in front of a face."""
        a = self.corner[face, 0]
        return (
            self.normal[face, 0] * (x - self.place[a, 0])
            + self.normal[face, 1] * (y - self.place[a, 1])
            + self.normal[face, 2] * (z - self.place[a, 2])
            > 0.0
        )

    def put(self, a: int, b: int, c: int) -> int:
        """Add a face with three corners; those beyond its edges are not known yet."""
        if self.freed > 0:
            self.freed -= 1
            face = self.free[self.freed]
        else:
            face = self.faces
            self.faces += 1
            self.waits[face] = 0
        self.corner[face, 0], self.corner[face, 1], self.corner[face, 2] = a, b, c
        self.first[face], self.seen[face] = -1, -1
        place, normal = self.place, self.normal
        ux, uy, uz = (
            place[b, 0] - place[a, 0],
            place[b, 1] - place[a, 1],
            place[b, 2] - place[a, 2],
        )
        vx, vy, vz = (
            place[c, 0] - place[a, 0],
            place[c, 1] - place[a, 1],
            place[c, 2] - place[a, 2],
        )
        normal[face, 0] = uy * vz - uz * vy
        normal[face, 1] = uz * vx - ux * vz
        normal[face, 2] = ux * vy - uy * vx
        return face

    def begin(self, count: int) -> bool:
        """Start with four points that are far from each other; False if all lie in a plane."""
        self.faces = self.freed = self.waiting = 0
        a, place = 0, self.place
        for i in range(1, count):
            if place[i, 0] < place[a, 0]:
                a = i
        b = self.farthest_from(a, a, count)
        c = self.farthest_from(a, b, count)
        face = self.put(a, b, c)
        d, most = a, cython.cast(cython.longlong, 0)
        for i in range(count):
            height = self.height(face, place[i, 0], place[i, 1], place[i, 2])
            if height > most or -height > most:
                d, most = i, height if height > 0 else -height
        if most == 0:
            return False
        self.faces = 0
        if self.sees(d, face):
            b, c = c, b
        self.put(a, b, c)
        self.put(b, a, d)
        self.put(c, b, d)
        self.put(a, c, d)
        self.join_first()
        for i in range(count):
            self.give(i, 0, 4)
        for face in range(4):
            self.wait_for(face)
        return True

    def join_first(self) -> None:
        """Set the neighbours of the first four faces."""
        for face in range(4):
            for i in range(3):
                tail = self.corner[face, i]
                head = self.corner[face, (i + 1) % 3]
                for other in range(4):
                    for j in range(3):
                        if (
                            self.corner[other, j] == head
                            and self.corner[other, (j + 1) % 3] == tail
                        ):
                            self.across[face, i] = other

    def farthest_from(self, a: int, b: int, count: int) -> int:
        """Return the point farthest from the line through two others.

        From the one, if they are one.
        """
        far, most, place = a, 0.0, self.place
        ux = cython.cast(cython.double, place[b, 0] - place[a, 0])
        uy = cython.cast(cython.double, place[b, 1] - place[a, 1])
        uz = cython.cast(cython.double, place[b, 2] - place[a, 2])
        for i in range(count):
            x = cython.cast(cython.double, place[i, 0] - place[a, 0])
            y = cython.cast(cython.double, place[i, 1] - place[a, 1])
            z = cython.cast(cython.double, place[i, 2] - place[a, 2])
            if a != b:
                x, y, z = uy * z - uz * y, uz * x - ux * z, ux * y - uy * x
            away = x * x + y * y + z * z
            if away > most:
                far, most = i, away
        return far

    def give(self, point: int, begin: int, end: int) -> None:
        """Assign a point to the first of the faces in ``patch`` order that it sees, if any."""
        for face in range(begin, end):
            if self.sees(point, face):
                self.after[point] = self.first[face]
                self.first[face] = point
                return

    def wait_for(self, face: int) -> None:
        """Queue a face if there are points outside of it."""
        if self.first[face] >= 0 and not self.waits[face]:
            self.waits[face] = 1
            self.queue[self.waiting] = face
            self.waiting += 1

    def farthest(self, face: int) -> int:
        """Return the point outside of a face that is farthest from its plane."""
        best, most = self.first[face], cython.cast(cython.longlong, 0)
        point, place = best, self.place
        while point >= 0:
            height = self.height(face, place[point, 0], place[point, 1], place[point, 2])
            if height > most:
                best, most = point, height
            point = self.after[point]
        return best

    def add(self, point: int, face: int) -> None:
        """Add a point that sees a face as a corner of the hull."""
        self.look(point, face)
        orphan = self.take_away(point)
        count = self.edges
        for k in range(count):  # ``patch`` is used again, for the faces that come
            tail, head, beyond = self.rim[k, 0], self.rim[k, 1], self.rim[k, 2]
            made = self.put(tail, head, point)
            self.patch[k] = made
            self.begins[tail] = made
            self.across[made, 0] = beyond
            for j in range(3):
                if self.corner[beyond, j] == head:
                    self.across[beyond, j] = made
        for k in range(count):
            made = self.patch[k]
            after = self.begins[self.corner[made, 1]]
            self.across[made, 1], self.across[after, 2] = after, made
        while orphan >= 0:
            next_one = self.after[orphan]
            for k in range(count):
                if self.sees(orphan, self.patch[k]):
                    self.after[orphan] = self.first[self.patch[k]]
                    self.first[self.patch[k]] = orphan
                    break
            orphan = next_one
        for k in range(count):
            self.wait_for(self.patch[k])

    def look(self, point: int, face: int) -> None:
        """Find the faces that a point sees, and the edges around them."""
        self.patch[0], self.seen[face] = face, point
        self.edges, count, k = 0, 1, 0
        while k < count:
            here = self.patch[k]
            k += 1
            for i in range(3):
                beyond = self.across[here, i]
                if self.seen[beyond] == point:
                    continue
                if self.sees(point, beyond):
                    self.seen[beyond] = point
                    self.patch[count] = beyond
                    count += 1
                else:
                    self.rim[self.edges, 0] = self.corner[here, i]
                    self.rim[self.edges, 1] = self.corner[here, (i + 1) % 3]
                    self.rim[self.edges, 2] = beyond
                    self.edges += 1
        self.visible = count

    def take_away(self, point: int) -> int:
        """Remove the faces that a point sees.

        Returns the first of the other points outside of them.
        """
        orphan = -1
        for k in range(self.visible):
            face = self.patch[k]
            other = self.first[face]
            while other >= 0:
                next_one = self.after[other]
                if other != point:
                    self.after[other] = orphan
                    orphan = other
                other = next_one
            self.corner[face, 0] = -1
            self.free[self.freed] = face
            self.freed += 1
        return orphan
