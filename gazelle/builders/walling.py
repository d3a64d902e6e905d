"""Walls along lines, with doors and windows, and rooms."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from gazelle.argument_checks import checked
from gazelle.builders.errors import BuildError, finite, positive
from gazelle.builders.paint import Paint
from gazelle.builders.solids import ORIGIN, Part, assemble, slab
from gazelle.description import Model, Pose

Point = tuple[float, float]
_SHORTEST = 1e-6  # what is shorter is no piece of wall [m]


@checked(BuildError)
@dataclass(frozen=True, slots=True)
class Opening:
    """A hole in a wall.

    Attributes:
        wall: Stretch of the line, counted from 0.
        at: Position of its middle from the start of that stretch [m].
        width: [m].
        bottom: Height of its lower edge [m]; 0 for a door.
        top: Height of its upper edge [m].
    """

    wall: int
    at: float
    width: float = 0.95
    bottom: float = 0.0
    top: float = 2.1


@checked(BuildError)
def door(wall: int, at: float, width: float = 0.95, height: float = 2.1) -> Opening:
    """Return a doorway in stretch ``wall``, its middle ``at`` [m] along it."""
    return Opening(wall, at, width, 0.0, height)


@checked(BuildError)
def window(
    wall: int, at: float, width: float = 1.6, bottom: float = 0.9, top: float = 2.1
) -> Opening:
    """Return a window in stretch ``wall``, its middle ``at`` [m] along it."""
    return Opening(wall, at, width, bottom, top)


@checked(BuildError)
def walls(
    points: Sequence[Point],
    *,
    name: str = "walls",
    height: float = 2.5,
    thickness: float = 0.15,
    closed: bool = False,
    openings: Sequence[Opening] = (),
    color: Paint = "plaster",
    pose: Pose = ORIGIN,
) -> Model:
    """Return walls along a line of points.

    Args:
        points: Corners of the middle line [m], at least two.
        name: Of the model.
        height: [m].
        thickness: [m].
        closed: Whether a last wall leads back to the first point.
        openings: Doors and windows.
        color: As ``material`` takes it.
        pose: Of the model in the world.

    Raises:
        BuildError: There are too few points, two neighbours coincide, or an opening does
            not fit into its wall or overlaps another.
    """
    positive(height, "the height of a wall")
    positive(thickness, "the thickness of a wall")
    stretches = _stretches(points, closed=closed)
    parts: list[Part] = []
    for number, (start, end) in enumerate(stretches):
        holes = sorted((o for o in openings if o.wall == number), key=lambda hole: hole.at)
        length = math.dist(start, end)
        _check_openings(holes, length, height)
        # Walls reach to the outer faces of the corners they share.
        before = thickness / 2.0 if closed or number > 0 else 0.0
        after = thickness / 2.0 if closed or number < len(stretches) - 1 else 0.0
        yaw = math.atan2(end[1] - start[1], end[0] - start[0])
        frame = Pose(*start, yaw=yaw)
        for piece, low, high, bottom, top in _pieces(holes, -before, length + after, height):
            middle = frame.apply(((low + high) / 2.0, 0.0, (bottom + top) / 2.0))
            size = (high - low, thickness, top - bottom)
            parts.append(slab(f"wall_{number}_{piece}", size, middle, color, yaw=yaw))
    unknown = [o.wall for o in openings if not 0 <= o.wall < len(stretches)]
    if unknown:
        raise BuildError(f"there is no wall {unknown[0]}: they are 0 to {len(stretches) - 1}")
    return assemble(name, parts, pose=pose)


@checked(BuildError)
def room(
    length: float,
    width: float,
    *,
    name: str = "room",
    height: float = 2.5,
    thickness: float = 0.15,
    openings: Sequence[Opening] = (),
    color: Paint = "plaster",
    pose: Pose = ORIGIN,
) -> Model:
    """Return four walls around the frame's origin; ``length`` and ``width`` are inside [m].

    Wall 0 is the one at -y and runs along x; the others follow counter-clockwise.

    Raises:
        BuildError: As ``walls``.
    """
    x = (positive(length, "the length of a room") + thickness) / 2.0
    y = (positive(width, "the width of a room") + thickness) / 2.0
    return walls(
        ((-x, -y), (x, -y), (x, y), (-x, y)),
        name=name,
        height=height,
        thickness=thickness,
        closed=True,
        openings=openings,
        color=color,
        pose=pose,
    )


def _stretches(points: Sequence[Point], *, closed: bool) -> list[tuple[Point, Point]]:
    line = [(float(x), float(y)) for x, y in points]
    if len(line) < 2 or (closed and len(line) < 3):
        raise BuildError(f"walls need at least {3 if closed else 2} points, found {len(line)}")
    finite(tuple(value for point in line for value in point), "the points of walls")
    ends = line[1:] + line[:1] if closed else line[1:]
    pairs = list(zip(line, ends, strict=False))
    for number, (start, end) in enumerate(pairs):
        if math.dist(start, end) < _SHORTEST:
            raise BuildError(f"wall {number} has no length: it starts and ends at {start}")
    return pairs


def _check_openings(holes: Sequence[Opening], length: float, height: float) -> None:
    reached = 0.0
    for hole in holes:
        positive(hole.width, "the width of an opening")
        low, high = hole.at - hole.width / 2.0, hole.at + hole.width / 2.0
        if not (0.0 <= hole.bottom < hole.top <= height):
            raise BuildError(
                f"an opening from {hole.bottom:g} to {hole.top:g} m does not fit "
                f"into a wall {height:g} m high"
            )
        if low < -_SHORTEST or high > length + _SHORTEST:
            raise BuildError(
                f"an opening from {low:g} to {high:g} m does not fit "
                f"into wall {hole.wall}, which is {length:g} m long"
            )
        if low < reached - _SHORTEST:
            raise BuildError(f"two openings of wall {hole.wall} overlap at {low:g} m")
        reached = high


def _pieces(
    holes: Sequence[Opening], start: float, end: float, height: float
) -> Iterator[tuple[int, float, float, float, float]]:
    """Yield number, start, end, bottom and top [m] of each piece that the holes leave."""
    solid: list[tuple[float, float, float, float]] = []
    reached = start
    for hole in holes:
        low, high = hole.at - hole.width / 2.0, hole.at + hole.width / 2.0
        solid += [
            (reached, low, 0.0, height),
            (low, high, 0.0, hole.bottom),
            (low, high, hole.top, height),
        ]
        reached = high
    solid.append((reached, end, 0.0, height))
    kept = (
        each for each in solid if each[1] - each[0] > _SHORTEST and each[3] - each[2] > _SHORTEST
    )
    for number, (low, high, bottom, top) in enumerate(kept):
        yield number, low, high, bottom, top
