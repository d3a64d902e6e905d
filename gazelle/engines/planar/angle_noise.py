"""Scanners with noise on the angles of their beams."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats
from gazelle.engines.planar.fan_scanner import FanScanner
from gazelle.engines.planar.fans import Fan, Mount, Scanner
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.scan_columns import ANGLE_NOISE

_SHARE = 1000  # beams that are worth a thread


class AngleNoiseScanner(Scanner):
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
        self._native = self._native_of(ANGLE_NOISE, solid=False)  # beams may be over solids
        self._share = _SHARE
        self._spread = np.ascontiguousarray(spread, np.float64)
        made: FanScanner | None = self._native
        while made is not None:
            made.spread, made = self._spread, made.next

    def call(self) -> None:
        """Scan with new noise; see ``Scanner.call``."""
        return
