"""Scans whose beams each go a little beside where they should."""

from __future__ import annotations

import math

from gazelle.engines.native import kernel
from gazelle.engines.planar.columns import NEAR, REACH, START
from gazelle.engines.planar.kernels_march import (
    BEST,
    MOST_LANES,
    NAME,
    meet_statics,
    put_lanes,
)
from gazelle.engines.planar.kernels_noise import stream, uniform
from gazelle.engines.planar.kernels_scan import aim, report
from gazelle.engines.planar.kernels_walk import meet_bodies
from gazelle.engines.planar.tables import Cells, Floats, Indices, Marks

PLACES = 1 << 40  # of the random numbers of angles, after those of ranges


@kernel
def scan_astray(
    first: int, last: int, sensors: Floats, owners: Indices, mounts: Floats, fan: Floats,
    step: float, spread: Floats, seed: int, tick: int, widest: float, grid: Floats,
    statics: Floats, kinds: Floats, looks: Floats, pose: Floats, head: Cells, follow: Cells,
    beams: Floats, others: Floats, fine: Floats, first_item: Cells, fine_items: Cells, free: Marks,
    going: Floats, ranges: Floats, names: Floats,
) -> None:  # fmt: skip
    """Scan with sensors first to last, with normal noise of ``spread`` [rad] on every angle."""
    total = beams.shape[1]
    for m in range(first, last):
        aim(sensors, m, owners, mounts, pose)
        mount, random = m % mounts.shape[0], stream(seed, int(owners[m]), tick)
        for base in range(0, total, MOST_LANES):
            count = min(MOST_LANES, total - base)
            for k in range(base, base + count):
                place = PLACES + 2 * (mount * total + k)
                radius = math.sqrt(-2.0 * math.log(uniform(random, place)))
                wave = radius * math.cos(2.0 * math.pi * uniform(random, place + 1))
                angle = fan[START] + k * step + spread[mount] * wave
                beams[0, k], beams[1, k] = math.cos(angle), math.sin(angle)
            put_lanes(going, 0, beams, base, count, fine, sensors, m, fan[REACH])
            meet_statics(going, count, fan[NEAR], statics, fine, first_item, fine_items, free)
            meet_bodies(
                going, 0, count, fan[NEAR], others, grid, widest, kinds, looks, pose, head,
                follow, int(owners[m]),
            )  # fmt: skip
            for k in range(count):
                beams[2, base + k], beams[3, base + k] = going[BEST + k], going[NAME + k]
        report(beams, m, fan[REACH], ranges, names)
