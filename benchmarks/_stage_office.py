"""Offices full of robots that roam about, for ``gazelle bench stage``."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from gazelle.engines.planar import Body, Drive, Fan, Fleet, Mount, PlanarPart, Scanner
from gazelle.engines.planar.roaming import Roaming

ROOM = 8.0  # side [m]
STEPS = 5  # that robots have made when they are handed out


def office(side: float, room: float = ROOM, x: float = 0.0, y: float = 0.0) -> list[PlanarPart]:
    """Return walls 0.1 m thick around rooms, each with a door of 1.2 m to the next one.

    Args:
        side: Of the office [m], in whole rooms.
        room: Side of a room [m].
        x: Its lower left corner [m].
        y: See x.
    """
    parts = []
    rooms = max(1, round(side / room))
    for i in range(rooms + 1):
        for j in range(rooms):
            at, low, high = i * room, j * room, (j + 1) * room
            door = (low + high) / 2.0
            runs = [(low, high)]
            if 0 < i < rooms:
                runs = [(low, door - 0.6), (door + 0.6, high)]
            for a, b in runs:
                parts.append(PlanarPart.box(0.1, b - a, x + at, y + (a + b) / 2.0))
                parts.append(PlanarPart.box(b - a, 0.1, x + (a + b) / 2.0, y + at))
    return parts


def places(count: int, across: int, pitch: float) -> list[tuple[float, float]]:
    """Return so many places in rows [m]."""
    return [(pitch * (i % across + 0.5), pitch * (i // across + 0.45)) for i in range(count)]


def roamers(
    spots: Iterable[tuple[float, float]],
    walls: list[PlanarPart],
    fan: Fan | None,
    threads: int,
    seed: int,
) -> Roaming:
    """Return robots of 0.26 m that have started to roam."""
    rng, shape, drive = np.random.default_rng(seed), (PlanarPart.box(0.2552, 0.2552),), Drive()
    bodies = [Body(shape, (x, y, rng.uniform(-3.0, 3.0)), drive=drive) for x, y in spots]
    fleet = Fleet(bodies, walls, euler=True, threads=threads)
    scanner = None if fan is None else Scanner(fleet, fan, [Mount(i) for i in range(len(bodies))])
    roaming = Roaming(fleet, scanner)
    roaming.run(STEPS)
    return roaming
