# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="no-any-return"
"""Convex pieces of a surface merged into larger ones that hold no air.

Bottom up, as Mamou and Ghorbel's "A simple and efficient approach for 3D mesh approximate convex
decomposition" (ICIP 2009). Two pieces that touch become the hull of both, unless it holds a
probe: a place in the air beside the surface. What a hull holds, a larger one holds: a pair that
was refused is never tried again.
"""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.geometry.air_probes import AirProbes
from cython.cimports.gazelle.geometry.pair_queue import PairQueue

from gazelle.array_types import Floats, Indices


@cython.final
@cython.cclass
class PieceMerger:
    """Pieces, each a convex hull of its points.

    Pieces touch along links, each of two ends: end 2 i + s of link i is in the list of its
    piece, and end 2 i + 1 - s in that of the other one. Of two pieces that are merged the first
    takes over the points and links of the second.

    Args:
        clouds: Points of each piece [m], shapes (n, 3).
        probes: Places that no hull of several pieces may hold [m], shape (k, 3).
    """

    def __init__(self, clouds: list[Floats], probes: Floats) -> None:
        sizes = np.array([len(cloud) for cloud in clouds], np.int32)
        count, most = len(clouds), int(sizes.sum())
        starts = np.cumsum(sizes) - sizes
        self.points = np.concatenate(clouds).astype(np.float64, order="C", copy=False)
        self.following = np.append(np.arange(1, most, dtype=np.int32), np.int32(-1))
        np.asarray(self.following)[starts[1:] - 1] = -1
        self.first = starts.astype(np.int32)
        self.box = np.concatenate(
            [f.reduceat(np.asarray(self.points), starts) for f in (np.minimum, np.maximum)], axis=1
        )
        self.number = np.arange(count, dtype=np.int32)  # -1 of pieces that others took over
        self.next_number = count
        self.probes = AirProbes(probes, most)
        self.cloud, self.member = np.zeros((most, 3)), np.zeros(most, np.int32)
        self.begins, self.touching = np.full((2, count), -1, np.int32)
        self.links = 0
        self.owner = self.after = self.before = np.zeros(0, np.int32)
        self.refused = np.zeros(0, np.uint8)

    def merge(self, pairs: Indices) -> None:
        """Merge pieces that touch, the smallest first, until no pair is left.

        Args:
            pairs: Rows of two pieces each that are linked by no refusal, shape (n, 2).
        """
        count = 2 * len(pairs)
        self.owner = np.append(self.owner, pairs.astype(np.int32).ravel())
        self.after = np.append(self.after, np.full(count, -1, np.int32))
        self.before = np.append(self.before, np.full(count, -1, np.int32))
        self.refused = np.append(self.refused, np.zeros(len(pairs), np.uint8))
        first, self.links = self.links, self.links + len(pairs)
        self.queue = PairQueue(self.links)
        with cython.nogil:
            self.merge_from(first)

    def clouds(self) -> list[Floats]:
        """Return the points of the pieces that are left."""
        numbers, points = np.asarray(self.number), np.asarray(self.points)
        rows = np.argsort(numbers, kind="stable")
        rows = rows[numbers[rows] >= 0]
        members = np.asarray(self.member)
        return [points[members[: self.gather(row, 0)]] for row in rows.tolist()]

    def overlapping(self, reach: float = 0.0) -> Indices:
        """Return the pairs of pieces with overlapping boxes that may still be merged.

        Args:
            reach: Distance between boxes that counts as none [m].
        """
        nothing = cython.declare(cython.Py_ssize_t[:, ::1], np.zeros((0, 2), np.intp))
        near = cython.declare(cython.double, reach)
        with cython.nogil:
            count = self.scan(nothing, near)
        pairs = np.zeros((count, 2), np.intp)
        found = cython.declare(cython.Py_ssize_t[:, ::1], pairs)
        with cython.nogil:
            self.scan(found, near)
        return pairs

    def scan(self, pairs: Indices, reach: float) -> int:
        """Write pairs of pieces with overlapping boxes, and return how many there are."""
        count = 0
        for row in range(self.number.shape[0]):
            if self.number[row] < 0:
                continue
            self.mark(row)
            for other in range(row + 1, self.number.shape[0]):
                free = self.number[other] >= 0 and self.touching[other] < 0
                if free and self.overlap(row, other, reach):
                    if count < pairs.shape[0]:
                        swapped = self.number[row] > self.number[other]
                        pairs[count, 0] = other if swapped else row
                        pairs[count, 1] = row if swapped else other
                    count += 1
            self.unmark(row)
        return count

    def overlap(self, one: int, other: int, reach: float) -> bool:
        """Return whether the boxes of two pieces overlap, or are this near."""
        for axis in range(3):
            if self.box[one, axis] > self.box[other, axis + 3] + reach:
                return False
            if self.box[other, axis] > self.box[one, axis + 3] + reach:
                return False
        return True

    def mark(self, piece: int) -> None:
        """Store for each piece that touches one the end of the link there."""
        end = self.begins[piece]
        while end >= 0:
            self.touching[self.owner[end ^ 1]] = end
            end = self.after[end]

    def unmark(self, piece: int) -> None:
        """Remove what ``mark`` stored."""
        end = self.begins[piece]
        while end >= 0:
            self.touching[self.owner[end ^ 1]] = -1
            end = self.after[end]

    def merge_from(self, first: int) -> None:
        """Merge pieces along the links from one on."""
        for link in range(first, self.links):
            self.add(2 * link)
            self.add(2 * link + 1)
            self.wait_for(link, self.owner[2 * link], self.owner[2 * link + 1])
        while self.queue.length > 0:
            link = self.queue.pop()
            one, other = self.owner[2 * link], self.owner[2 * link + 1]
            count = self.gather(other, self.gather(one, 0))
            kept = self.probes.keep(self.cloud[:count])
            if kept < 0:
                self.refused[link] = 1
            else:
                self.join(one, other)
                self.take(one, kept)
                self.relink(one)

    def wait_for(self, link: int, one: int, other: int) -> None:
        """Queue a link by the size of the box around both pieces."""
        size = 0.0
        for axis in range(3):
            side = max(self.box[one, axis + 3], self.box[other, axis + 3])
            side -= min(self.box[one, axis], self.box[other, axis])
            size += side * side
        self.queue.push(link, size, self.number[one], self.number[other])

    def gather(self, piece: int, count: int) -> int:
        """Append the points of a piece to those gathered; returns how many these are."""
        point = self.first[piece]
        while point >= 0:
            self.member[count] = point
            for axis in range(3):
                self.cloud[count, axis] = self.points[point, axis]
            count += 1
            point = self.following[point]
        return count

    def take(self, piece: int, kept: int) -> None:
        """Set the points of a piece to those gathered that are corners."""
        rows, last = self.probes.rows, -1
        for axis in range(3):
            self.box[piece, axis] = self.box[piece, axis + 3] = self.cloud[rows[0], axis]
        for k in range(kept):
            point = self.member[rows[k]]
            if last < 0:
                self.first[piece] = point
            else:
                self.following[last] = point
            last = point
            for axis in range(3):
                place = self.points[point, axis]
                self.box[piece, axis] = min(self.box[piece, axis], place)
                self.box[piece, axis + 3] = max(self.box[piece, axis + 3], place)
        self.following[last] = -1

    def join(self, one: int, other: int) -> None:
        """Move the links of the ``other`` piece to the one."""
        self.mark(one)
        end = self.begins[other]
        while end >= 0:
            after, beyond = self.after[end], end ^ 1
            third = self.owner[beyond]
            self.queue.remove(end >> 1)
            if third == one or self.touching[third] >= 0:
                self.drop(beyond)
                if third != one and self.refused[end >> 1]:
                    self.refused[self.touching[third] >> 1] = 1
            else:
                self.owner[end] = one
                self.add(end)
            end = after
        self.unmark(one)
        self.begins[other] = self.number[other] = -1

    def relink(self, piece: int) -> None:
        """Set a new number for a piece that has grown, and queue its links again."""
        end = self.begins[piece]
        while end >= 0:
            self.queue.remove(end >> 1)
            end = self.after[end]
        self.number[piece] = self.next_number
        self.next_number += 1
        end = self.begins[piece]
        while end >= 0:
            if not self.refused[end >> 1]:
                self.wait_for(end >> 1, piece, self.owner[end ^ 1])
            end = self.after[end]

    def add(self, end: int) -> None:
        """Add an end to the list of its piece."""
        piece = self.owner[end]
        head = self.begins[piece]
        self.after[end], self.before[end] = head, -1
        if head >= 0:
            self.before[head] = end
        self.begins[piece] = end

    def drop(self, end: int) -> None:
        """Remove an end from the list of its piece."""
        after, before = self.after[end], self.before[end]
        if before >= 0:
            self.after[before] = after
        else:
            self.begins[self.owner[end]] = after
        if after >= 0:
            self.before[after] = before
