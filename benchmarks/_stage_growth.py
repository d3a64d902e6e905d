"""What a robot costs among ever more robots that see the same, for ``gazelle bench stage``.

Halls with 100 robots each stand side by side in one world, so that a robot has as much around it
in the largest world as in the smallest; all are measured over the same time after the start.
"""

from __future__ import annotations

import math
import time

import numpy as np
from _stage_goals import Goals

from gazelle.engines.planar import Body, Drive, Fan, Fleet, Mount, Part, Scanner
from gazelle.engines.planar.roaming import Roaming

CROWD = 100  # robots of a hall
ROOM = 6.4  # side of one of its four rooms [m]
PITCH = 20.0  # from hall to hall [m]: lasers do not see from one into the next
HALLS = (1, 10, 100, 1_000)
STEPS = 5  # that are measured, after as many
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
    """Processor time of a robot's step and scan [ns], the least of three."""
    times = []
    for window in range(3):
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
    """Robots that have begun to roam."""
    rng, across = np.random.default_rng(seed), math.ceil(math.sqrt(halls))
    side = math.isqrt(CROWD)
    pitch, shape, drive = 2.0 * ROOM / side, (Part.box(0.2552, 0.2552),), Drive()
    walls, bodies = [], []
    for hall in range(halls):
        x, y = PITCH * (hall % across), PITCH * (hall // across)
        walls += hall_at(x, y)
        for i in range(CROWD):
            place = (x + pitch * (i % side + 0.5), y + pitch * (i // side + 0.45))
            bodies.append(Body(shape, (*place, rng.uniform(-3.0, 3.0)), drive=drive))
    fleet = Fleet(bodies, walls, euler=True, threads=threads)
    scanner = None if fan is None else Scanner(fleet, fan, [Mount(i) for i in range(len(bodies))])
    roaming = Roaming(fleet, scanner)
    roaming.run(STEPS)
    return roaming


def hall_at(x: float, y: float) -> list[Part]:
    """Four rooms in a square, walls 0.1 m thick, with doors of 1.2 m between them."""
    parts = []
    for i in range(3):
        for j in range(2):
            at, low, high = i * ROOM, j * ROOM, (j + 1) * ROOM
            door = (low + high) / 2.0
            runs = [(low, high)] if i != 1 else [(low, door - 0.6), (door + 0.6, high)]
            for a, b in runs:
                parts.append(Part.box(0.1, b - a, x + at, y + (a + b) / 2.0))
                parts.append(Part.box(b - a, 0.1, x + (a + b) / 2.0, y + at))
    return parts
