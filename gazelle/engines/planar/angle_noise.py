"""Scanners with noise on the angles of their beams."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.engines.planar.fan_scanner import FanScanner
from gazelle.engines.planar.fans import Fan, Mount, Scanner
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.scan_columns import ANGLE_NOISE
from gazelle.errors import EngineError

_SHARE = 1000  # beams that are worth a thread


@checked(EngineError)
class AngleNoiseScanner(Scanner):
    """A scanner with normal noise on the angle of every beam, new in every scan.

    The numbers are hashes of the seed, the body, the scan and the beam, so they are the same at
    any number of threads and worlds.

    Args:
        fleet: Fleet of the rays.
        fan: The beams as they should be.
        mounts: Mounts of the sensors.
        spread: Standard deviation of the angles of each [rad], shape (mounts,).
        named: Whether to remember what each beam met.
        seed: Of the noise.

    Raises:
        EngineError: The fan is invalid, there is no such body, or there are more or fewer spreads
            than mounts.
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
        if self._spread.shape != (len(mounts),):
            raise EngineError(
                f"angles need a spread for each of {len(mounts)} mounts, not {spread}"
            )
        made: FanScanner | None = self._native
        while made is not None:
            made.spread, made = self._spread, made.next
