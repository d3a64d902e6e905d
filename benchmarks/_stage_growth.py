"""Cost of a robot among ever more robots that see the same, for ``gazelle bench stage``.

Halls with 100 robots each stand side by side in one world, so that a robot has as much around it
in the largest world as in the smallest; all are measured over the same time after the start, as
many steps as they made before.
"""

from __future__ import annotations

import math
import time

from _goals import Goals
from _stage_office import STEPS, office, places, roamers

from gazelle.engines.planar import Fan
from gazelle.engines.planar.roaming import Roaming

CROWD = 100  # robots of a hall
ROOM = 6.4  # side of one of its four rooms [m]
PITCH = 20.0  # from hall to hall [m]: lasers do not see from one into the next
HALLS = (1, 10, 100, 1_000)
LEAST = 3_000  # robots that are measured, in as many worlds as that takes


def growth(sensors: dict[str, Fan | None], largest: int, threads: int, goals: Goals) -> None:
    """Print the cost of a robot in more and more halls."""
    sizes = [count for count in HALLS if count * CROWD <= largest]
    print(f"\nhalls of {CROWD} robots side by side in one world, ns a robot and step")
    print(f"{'sensor':<17}" + "".join(f"{count * CROWD:>10,}" for count in sizes) + f"{'times':>8}")
    for name, fan in sensors.items():
        costs = [cost(count, fan, threads) for count in sizes]
        times = max(costs) / min(costs)
        print(f"{name:<17}" + "".join(f"{each:>10,.0f}" for each in costs) + f"{times:>8.2f}")
        goals.most(f"cost a robot from 100 up, {name.split()[0]}: times", times, 1.5)


def cost(halls: int, fan: Fan | None, threads: int) -> float:
    """Return processor time of a robot's step and scan [ns], the least of two."""
    times = []
    for window in range(2):
        worlds = [
            world(halls, fan, threads, seed)
            for seed in range(window, window + max(1, LEAST // (halls * CROWD)))
        ]
        began = time.process_time()
        for each in worlds:
            each.run(STEPS)
        times.append((time.process_time() - began) / (len(worlds) * halls * CROWD * STEPS))
        for each in worlds:
            each.fleet.close()
    return 1e9 * min(times)


def world(halls: int, fan: Fan | None, threads: int, seed: int) -> Roaming:
    """Return robots that have started to roam."""
    across, side = math.ceil(math.sqrt(halls)), math.isqrt(CROWD)
    corners = [(PITCH * (hall % across), PITCH * (hall // across)) for hall in range(halls)]
    own = places(CROWD, side, 2.0 * ROOM / side)
    spots = [(x + dx, y + dy) for x, y in corners for dx, dy in own]
    walls = [part for x, y in corners for part in office(2.0 * ROOM, ROOM, x, y)]
    return roamers(spots, walls, fan, threads, seed)
