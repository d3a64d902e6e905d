"""Scanners whose beams go astray."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.engines.planar.fans import Fan, Mount, Scanner
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.kernels_astray import scan_astray
from gazelle.engines.planar.kernels_march import LANES

_SHARE = 1000  # beams that are worth a thread


class AstrayScanner(Scanner):
    """A scanner with normal noise on the angle of every beam, new in every scan.

    The numbers are hashes of the seed, the body, the scan and the beam, so they are the same at
    any number of threads and worlds.

    Args:
        fleet: What it looks at.
        fan: The beams as they should be.
        mounts: Where they start.
        spread: Standard deviation of the angles of each [rad].
        named: Whether to remember what each beam met.
        seed: Of the noise.
    """

    def __init__(
        self,
        fleet: Fleet,
        fan: Fan,
        mounts: Sequence[Mount],
        spread: Floats,
        *,
        named: bool = False,
        seed: int = 0,
    ) -> None:
        super().__init__(fleet, fan, mounts, named=named, seed=seed)
        self._spread = np.ascontiguousarray(spread, np.float64)
        self._there = fleet.scene.clearing(solid=False)  # they may be over what is solid
        self._going = [np.zeros(LANES) for _ in range(fleet.crew.size)]

    def call(self) -> None:
        """See ``Scanner.call``: its noise is another one in each scan."""
        return

    def scan(self, worlds: NDArray[np.intp] | None = None) -> Floats:
        """See ``Scanner.scan``."""
        owners, count = self.owners, self.fleet.nworld
        if worlds is not None:
            owners, count = self._owners_in(worlds), len(worlds)
        ranges, tick = self.flat_ranges, self.tick

        fleet, there = self.fleet, self._there

        def work(first: int, last: int, part: int) -> None:
            sensors, _, mounts, fan, _, beams, *_, others = self.arguments(part)
            scan_astray(
                first, last, sensors, owners, mounts, fan, self.fan.step, self._spread, self.seed,
                tick, fleet.widest, fleet.scene.grid, fleet.scene.table.rows, fleet.kinds,
                fleet.looks, fleet.rows, fleet.head, fleet.follow, beams, others, there.fine,
                there.start, there.items, there.clear, self._going[part], ranges, self.names,
            )  # fmt: skip

        fleet.crew.share(work, len(owners), max(1, _SHARE // self.fan.count))
        self.tick += 1
        return self.ranges[:count]
