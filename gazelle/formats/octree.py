"""Octrees of OctoMap, as in ``octomap_msgs/Octomap``: occupied space."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Ints32
from gazelle.errors import FormatError, did_you_mean
from gazelle.formats.octree_leaves import CUT_SHORT, DEPTH, TOO_DEEP, TOO_MANY, occupied_leaves

_RECORDS: Final = {"OcTree": 4, "ColorOcTree": 7}
"""Classes of octrees, and how long their nodes are but for the byte with their children: log-odds,
and the colour of the latter."""
_MOST_BYTES: Final = 64 << 20
_MOST_LEAVES: Final = 2_000_000


@checked(FormatError)
@dataclass(frozen=True, slots=True, eq=False)
class Octree:
    """An octree of occupied space.

    Attributes:
        resolution: Edge of its finest leaves [m].
        data: As OctoMap writes it, without the head of a file.
        binary: Whether leaves are only occupied, free or unknown (``writeBinaryData``), rather than
            log-odds (``writeData``), which are occupied from 0 on: a probability of 0.5.
        kind: OctoMap's class: ``OcTree`` or ``ColorOcTree``.
    """

    resolution: float
    data: bytes
    binary: bool = True
    kind: str = "OcTree"

    def cuboids(self) -> tuple[Floats, Floats]:
        """Return middles and edges of the occupied cuboids, in the map's frame [m], each (n, 3).

        Leaves, at their own sizes, are joined where several make a larger cuboid.

        Raises:
            FormatError: The data is no octree, is damaged, or is larger than 64 MiB or 2 million
                occupied leaves.
        """
        leaves = self._leaves()
        low, edges = joined(leaves[:, :3], np.repeat(leaves[:, 3:], 3, axis=1))
        middle = 1 << (DEPTH - 1)
        wide = edges * np.float64(self.resolution)
        return (low - middle) * self.resolution + wide / 2.0, wide

    def _leaves(self) -> Ints32:
        if not (math.isfinite(self.resolution) and self.resolution > 0.0):
            raise FormatError(
                f"the resolution of an octree must be a length above zero, not {self.resolution}"
            )
        if self.kind not in _RECORDS:
            raise FormatError(
                f"an octree of the class '{self.kind}' cannot be read",
                hint=did_you_mean(self.kind, _RECORDS) or f"there are {', '.join(_RECORDS)}",
            )
        if len(self.data) > _MOST_BYTES:
            raise FormatError(
                f"an octree of {len(self.data):,} bytes is more than {_MOST_BYTES:,}",
                hint="make it coarser, or send the part around the robot",
            )
        record = 0 if self.binary else _RECORDS[self.kind]
        data = np.frombuffer(self.data, np.uint8).copy()
        outcome, read, leaves = occupied_leaves(data, record, _MOST_LEAVES)
        self._check(outcome, read)
        return leaves

    def _check(self, outcome: int, read: int) -> None:
        if outcome == TOO_MANY:
            raise FormatError(
                f"an octree has more than {_MOST_LEAVES:,} occupied leaves",
                hint="make it coarser, or send the part around the robot",
            )
        form = "binary" if self.binary else "full"
        what = f"the octree's {len(self.data):,} bytes are not what its {form} form is"
        hint = "is 'binary' as the data was written, and the class right?"
        if outcome == CUT_SHORT:
            raise FormatError(f"{what}: a node at byte {read:,} is cut short", hint=hint)
        if outcome == TOO_DEEP:
            words = f"a node at byte {read:,} is deeper than {DEPTH} levels"
            raise FormatError(f"{what}: {words}", hint=hint)
        if read < len(self.data):
            raise FormatError(f"{what}: it ends at byte {read:,}", hint=hint)


def joined(low: Ints32, edges: Ints32) -> tuple[Ints32, Ints32]:
    """Return disjoint cuboids, joined into fewer that fill the same space.

    Those that are beside each other and equally wide are one, along x, then y, then z, until that
    changes nothing.

    Args:
        low: Lower corners, shape (n, 3).
        edges: Shape (n, 3).
    """
    count = -1
    while count != len(low):
        count = len(low)
        for axis in range(3):
            low, edges = _joined_along(axis, low, edges)
    return low, edges


def _joined_along(axis: int, low: Ints32, edges: Ints32) -> tuple[Ints32, Ints32]:
    """Return cuboids joined along an axis."""
    aside = [other for other in range(3) if other != axis]
    section = np.column_stack([low[:, aside], edges[:, aside]])
    order = np.lexsort((low[:, axis], *section.T))
    low, edges, section = low[order], edges[order], section[order]
    follows = low[1:, axis] == low[:-1, axis] + edges[:-1, axis]
    follows &= (section[1:] == section[:-1]).all(axis=1)
    first = np.flatnonzero(np.concatenate([[True], ~follows])[: len(low)])
    if len(first) == len(low):
        return low, edges
    made = edges[first]
    made[:, axis] = np.add.reduceat(edges[:, axis], first)
    return low[first], made
