"""What the kernels of ``kernels_scan`` take: scans that are played from a tape with other kernels."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.engines.native import Call, Function
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.kernels_front import MANY, scan_crowded
from gazelle.engines.planar.kernels_march import LANES, SIDE_BY_SIDE
from gazelle.engines.planar.kernels_scan import scan
from gazelle.engines.planar.kernels_walk import FEW_BEAMS, scan_singly

_BLOCK = 64  # primitives that are prepared at once; more than make a grid worth it
_CROWD = 128  # bodies that are sorted at once


@dataclass(frozen=True, slots=True)
class _Scratch:
    """What a thread writes on while it scans."""

    beams: Floats
    view: Floats
    stamp: NDArray[np.int64]
    begins: Floats
    walls: Floats = field(default_factory=lambda: np.zeros((9, _BLOCK)))
    others: Floats = field(default_factory=lambda: np.zeros((18, _CROWD)))
    going: Floats = field(default_factory=lambda: np.zeros(LANES))


class TapedScan:
    """The scan of a scanner as a call of a kernel.

    Args:
        fleet: What it looks at.
        angles: Of the beams [rad], shape (count,).
        results: Bodies of the sensors, and what comes out: ranges and names.
        row: Its fan as ``columns.START`` and what follows say.
        outline: Around all that it sees, shape (n, 2).
        middles: Directions of the middles of bundles of beams, shape (2, n).
        mounts: Places on bodies, shape (n, SENSOR).
    """

    def __init__(
        self,
        fleet: Fleet,
        angles: Floats,
        results: tuple[NDArray[np.int64], Floats, Floats],
        row: Floats,
        outline: Floats,
        middles: Floats,
        mounts: Floats,
    ) -> None:
        self._fleet, self._results = fleet, results
        self._fan, self._outline, self._middles = row, outline, middles
        self._mounts = mounts
        count = len(angles)
        beams = np.zeros((4, count))
        beams[0], beams[1] = np.cos(angles), np.sin(angles)
        statics = len(fleet.scene.table.rows)
        self._scratch = [
            _Scratch(
                beams.copy(),
                np.zeros_like(outline),
                np.zeros(statics + 1, np.int64),
                np.zeros(-(-count // SIDE_BY_SIDE)),
            )
            for _ in range(fleet.crew.size)
        ]
        self._look = _look_of(count, fleet)
        self._sensors = np.zeros((len(results[0]), c.SENSOR))

    def call(self) -> Call:
        """What scans everywhere in one thread."""
        own, results = self.arguments(0), self._results
        extra = () if self._look is scan else self._ahead()
        return self._look, (
            0, len(results[0]), *own[:5], self._fleet.widest, *self.surroundings(), *own[5:],
            *extra, results[1], results[2],
        )  # fmt: skip

    def surroundings(self) -> tuple[Any, ...]:
        """What ``kernels_scan.scan`` works on of the fleet, but for the largest radius."""
        fleet, scene = self._fleet, self._fleet.scene
        return (
            scene.grid, scene.table.rows, scene.start, scene.items, scene.lanes, fleet.kinds,
            fleet.looks, fleet.rows, fleet.head, fleet.follow,
        )  # fmt: skip

    def arguments(self, part: int) -> tuple[Any, ...]:
        """What ``kernels_scan.scan`` works on for one thread, but for the fleet and results."""
        own = self._scratch[part]
        return (
            self._sensors, self._results[0], self._mounts, self._fan, self._outline,
            own.beams, own.view, own.stamp, own.walls, own.others,
        )  # fmt: skip

    def _ahead(self) -> tuple[Any, ...]:
        """Where statics are, for kernels in which beams go through clear space."""
        there = self._fleet.scene.clearing(solid=self._fan[c.NEAR] == math.inf)
        own = self._scratch[0]
        return (
            there.fine, there.start, there.items, there.clear, own.going, own.begins,
            self._middles,
        )  # fmt: skip


def _look_of(count: int, fleet: Fleet) -> Function:
    scene = fleet.scene
    if scene.cells > 1 and count <= FEW_BEAMS:
        return scan_singly
    return scan_crowded if scene.cells > 1 and len(scene.items) > MANY else scan
