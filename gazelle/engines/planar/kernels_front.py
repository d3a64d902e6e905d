"""Follow the beams of a scan among many statics, so that what is hidden is not looked at.

Beams go through the grid of clear space side by side, at first in bundles as one. Cost grows with
what can be seen, not with what is within the beams' reach.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.engines.native import inner, kernel, part
from gazelle.engines.planar.columns import (
    FAMILY,
    NEAR,
    RATE,
    REACH,
    S_Z,
)
from gazelle.engines.planar.kernels_march import (
    AT,
    BASE,
    BEST,
    COLUMNS,
    END,
    MOST_LANES,
    NAME,
    OUT,
    ROWS,
    SIDE_BY_SIDE,
    is_clear,
    march_bundles,
    meet_statics,
    put_lanes,
)
from gazelle.engines.planar.kernels_scan import (
    aim,
    cells_of,
    clear,
    draw_view,
    put_view,
    report,
    rows_of,
)
from gazelle.engines.planar.tables import Cells, Floats, Indices, Marks

MANY = 256  # statics in view from which it pays to find out which ones are hidden
NARROW = 0.2  # of bundles [rad]


@part
def begin_bundles(
    lanes: Floats, begins: Floats, middles: Floats, fan: Floats, sensors: Floats, m: int,
    fine: Floats, free: Marks,
) -> None:  # fmt: skip
    """Find how far each bundle of beams goes through empty space, at least [m]."""
    half = 0.5 * SIDE_BY_SIDE / fan[RATE]
    spread = math.sin(half) / math.cos(half)
    for base in range(0, begins.size, MOST_LANES):
        count = min(MOST_LANES, begins.size - base)
        put_lanes(lanes, 0, middles, base, count, fine, sensors, m, fan[REACH])
        around = 4.0 * fine[COLUMNS] * fine[ROWS]
        for i in range(np.uint64(count)):
            lanes[AT + i], lanes[END + i], lanes[BASE + i] = 0.0, lanes[OUT + i], around
        march_bundles(lanes, count, fine, free, spread)
        for i in range(np.uint64(count)):
            begins[base + i] = lanes[AT + i]


@part
def meet_ahead(
    beams: Floats, fan: Floats, lanes: Floats, begins: Floats, middles: Floats, sensors: Floats,
    m: int, statics: Floats, fine: Floats, start: Cells, items: Cells, free: Marks,
) -> None:  # fmt: skip
    """Let all beams meet the statics."""
    narrow = NARROW * fan[RATE] > SIDE_BY_SIDE
    if narrow:
        begin_bundles(lanes, begins, middles, fan, sensors, m, fine, free)
    for base in range(0, beams.shape[1], SIDE_BY_SIDE):
        count = min(SIDE_BY_SIDE, beams.shape[1] - base)
        put_lanes(lanes, 0, beams, base, count, fine, sensors, m, fan[REACH])
        if narrow:
            begin = begins[base // SIDE_BY_SIDE]
            for i in range(np.uint64(count)):
                lanes[AT + i] = max(lanes[AT + i], begin)
        meet_statics(lanes, count, fan[NEAR], statics, fine, start, items, free)
        for i in range(np.uint64(count)):
            beams[2, base + i], beams[3, base + i] = lanes[BEST + i], lanes[NAME + i]


@inner
def farthest(beams: Floats) -> float:
    """How far the beam is that has got farthest [m]."""
    least = math.inf
    for k in range(beams.shape[1]):
        least = min(least, beams[2, k])
    return 1.0 / least


@part
def is_crowded(view: Floats, grid: Floats, start: Cells) -> bool:
    """Whether so many statics are listed in cells in view that it pays to find those to be seen."""
    bottom, top = rows_of(view, grid, 0.0)
    listed = 0
    for r in range(bottom, top + 1):
        left, right = cells_of(view, grid, 0.0, r)
        listed += int(start[right + 1] - start[left])
    return listed > MANY


@kernel
def scan_crowded(
    first: int, last: int, sensors: Floats, owners: Indices, mounts: Floats, fan: Floats,
    outline: Floats, widest: float, grid: Floats, statics: Floats, start: Cells, items: Cells, lanes: Floats,
    kinds: Floats, looks: Floats, pose: Floats, head: Cells, follow: Cells, beams: Floats,
    view: Floats, stamp: Indices, walls: Floats, others: Floats, fine: Floats, first_item: Cells,
    fine_items: Cells, free: Marks, going: Floats, begins: Floats,
    middles: Floats, ranges: Floats, names: Floats,
) -> None:  # fmt: skip
    """What ``kernels_scan.scan`` does, faster where many statics are in view."""
    for m in range(first, last):
        aim(sensors, m, owners, mounts, pose)
        world = owners[m] // kinds.shape[0]
        me = kinds[owners[m] - world * kinds.shape[0], FAMILY]
        clear(beams, 1.0 / fan[REACH])
        put_view(view, outline, sensors, m, 1.0)
        crowded = is_clear(fine, sensors[m, S_Z]) and is_crowded(view, grid, start)
        if crowded:
            meet_ahead(
                beams, fan, going, begins, middles, sensors, m, statics, fine, first_item,
                fine_items, free,
            )  # fmt: skip
            put_view(view, outline, sensors, m, farthest(beams) / fan[REACH])
        draw_view(
            beams, fan, sensors, m, view, widest, grid, statics, start, items, lanes, stamp,
            kinds, looks, pose, head, follow, world, me, walls, others, crowded,
        )  # fmt: skip
        report(beams, m, fan[REACH], ranges, names)
