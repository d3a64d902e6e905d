"""Buildings, roads and fences."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from gazelle.argument_checks import checked
from gazelle.builders.errors import BuildError, finite, positive
from gazelle.builders.limits import MAX_PARTS
from gazelle.builders.paint import Paint
from gazelle.builders.solids import ORIGIN, Part, assemble, post, slab
from gazelle.builders.walling import Point
from gazelle.description import Box, Model, Pose

_STOREY = 3.0
_LAYER = 0.006  # a road's asphalt, and on it its lines [m]


@checked(BuildError)
def building(
    name: str = "building",
    *,
    length: float = 10.0,
    width: float = 8.0,
    storeys: int = 2,
    pitched: bool = True,
    pose: Pose = ORIGIN,
    color: Paint = "brick",
    roof: Paint = "roof",
) -> Model:
    """Return a house seen from outside: solid, with windows, and a door at -y.

    Args:
        name: Of the model.
        length: Along x [m].
        width: Along y [m].
        storeys: Each 3 m high, at least 1.
        pitched: A saddle roof along x; else a flat one.
        pose: Of the middle of the ground floor, in the world.
        color: Of the walls.
        roof: Of the roof.

    Raises:
        BuildError: It is shorter than 3 m, or has no storey.
    """
    if min(length, width) < 3.0 or storeys < 1:
        raise BuildError(
            f"a building of {length:g} m x {width:g} m with {storeys} storeys is not possible"
        )
    if 2.0 * (length + width) * storeys > MAX_PARTS:  # no less than a metre a window
        raise BuildError(
            f"a building of {length:g} m x {width:g} m with {storeys} storeys has too many windows",
            hint=f"the walls are up to {MAX_PARTS} m, all storeys together",
        )
    height = storeys * _STOREY
    parts = [slab("body", (length, width, height), (0.0, 0.0, height / 2.0), color)]
    parts += _saddle(length, width, height, roof, color) if pitched else [
        slab("roof", (length + 0.3, width + 0.3, 0.35), (0.0, 0.0, height + 0.175), roof)
    ]  # fmt: skip
    parts += _windows(length, width, storeys)
    parts.append(slab("door", (1.1, 0.06, 2.2), (0.0, -width / 2.0, 1.1), "walnut", collides=False))
    return assemble(name, parts, pose=pose)


def _saddle(length: float, width: float, height: float, roof: Paint, gable: Paint) -> list[Part]:
    """Return two tilted slabs, and steps of wall under them that close the gables."""
    rise = 0.32 * width
    tilt = math.atan2(rise, width / 2.0)
    slope = math.hypot(rise, width / 2.0) + 0.5
    parts = []
    for side, sign in (("left", 1.0), ("right", -1.0)):
        middle = Pose(0.0, sign * width / 4.0, height + rise / 2.0, roll=-sign * tilt)
        down = middle * Pose(y=sign * 0.22, z=0.1)
        parts.append(Part(f"roof_{side}", Box((length + 0.6, slope, 0.2)), down, roof))
    steps = 8
    for step in range(steps):
        across = width * (1.0 - (step + 0.5) / steps)
        z = height + rise * (step + 0.5) / steps
        parts.append(slab(f"gable_{step}", (length, across, rise / steps), (0.0, 0.0, z), gable))
    return parts


def _windows(length: float, width: float, storeys: int) -> list[Part]:
    """Return panes on all four sides; none where the door is."""
    parts = []
    for storey in range(storeys):
        z = storey * _STOREY + 1.6
        for side, across, depth in (("y", length, width), ("x", width, length)):
            count = max(1, int(across // 2.6))
            for number in range(count):
                at = ((number + 0.5) / count - 0.5) * across
                for face in (-1.0, 1.0):
                    door = side == "y" and face < 0.0 and storey == 0 and abs(at) < 1.3
                    if not door:
                        label = f"window_{side}{'-' if face < 0 else '+'}_{storey}_{number}"
                        parts.append(_window(label, side, at, face * depth / 2.0, z))
    return parts


def _window(name: str, side: str, at: float, out: float, z: float) -> Part:
    if side == "y":
        return slab(name, (1.1, 0.05, 1.3), (at, out, z), "glass", collides=False)
    return slab(name, (0.05, 1.1, 1.3), (out, at, z), "glass", collides=False)


@checked(BuildError)
def road(
    points: Sequence[Point],
    *,
    name: str = "road",
    width: float = 6.0,
    line: bool = True,
    pose: Pose = ORIGIN,
    color: Paint = "asphalt",
) -> Model:
    """Return a road along a line of points; it shows and touches nothing, as in Gazebo.

    Args:
        points: Of its middle line [m], at least two.
        name: Of the model.
        width: [m].
        line: Whether a broken white line runs along its middle.
        pose: Of the model in the world.
        color: Of its surface.

    Raises:
        BuildError: There are too few points, two neighbours coincide, or one is not finite.
    """
    positive(width, "the width of a road")
    if len(points) < 2:
        raise BuildError(f"a road needs at least 2 points, found {len(points)}")
    finite(tuple(value for point in points for value in point), "the points of a road")
    parts: list[Part] = []
    for number, ((x0, y0), (x1, y1)) in enumerate(pairwise(points)):
        length = math.hypot(x1 - x0, y1 - y0)
        if length == 0.0:
            raise BuildError(f"two neighbouring points of a road coincide at ({x0:g}, {y0:g})")
        start = Pose(x0, y0, yaw=math.atan2(y1 - y0, x1 - x0))
        bed = Part(
            f"bed_{number}",
            Box((length, width, _LAYER)),
            start * Pose(x=length / 2.0, z=_LAYER / 2.0),
            color,
            collides=False,
        )
        parts.append(bed)
        if number:
            at = (x0, y0, _LAYER / 2.0)
            parts.append(post(f"bend_{number}", width / 2.0, _LAYER, at, color, collides=False))
        parts += _dashes(number, start, length) if line else []
    return assemble(name, parts, pose=pose)


def _dashes(number: int, start: Pose, length: float) -> list[Part]:
    count = max(1, round(length / 3.0))
    dash = (1.5 / 3.0) * length / count
    return [
        Part(
            f"line_{number}_{i}",
            Box((dash, 0.12, _LAYER)),
            start * Pose(x=(i + 0.5) * length / count, z=1.5 * _LAYER),
            "white",
            collides=False,
        )
        for i in range(count)
    ]


@checked(BuildError)
def fence(
    points: Sequence[Point],
    *,
    name: str = "fence",
    height: float = 1.1,
    pose: Pose = ORIGIN,
    color: Paint = "oak",
) -> Model:
    """Return a wooden fence along a line of points: posts at most 2 m apart, and two rails.

    Raises:
        BuildError: There are too few points, two neighbours coincide, or one is not finite.
    """
    positive(height, "the height of a fence")
    if len(points) < 2:
        raise BuildError(f"a fence needs at least 2 points, found {len(points)}")
    finite(tuple(value for point in points for value in point), "the points of a fence")
    parts: list[Part] = []
    for number, ((x0, y0), (x1, y1)) in enumerate(pairwise(points)):
        length = math.hypot(x1 - x0, y1 - y0)
        if length == 0.0:
            raise BuildError(f"two neighbouring points of a fence coincide at ({x0:g}, {y0:g})")
        yaw = math.atan2(y1 - y0, x1 - x0)
        count = max(1, math.ceil(length / 2.0))
        last = number == len(points) - 2
        for i in range(count + last):
            at = (x0 + (x1 - x0) * i / count, y0 + (y1 - y0) * i / count, height / 2.0)
            parts.append(slab(f"post_{number}_{i}", (0.1, 0.1, height), at, color, yaw=yaw))
        for rail, share in (("low", 0.45), ("high", 0.85)):
            at = ((x0 + x1) / 2.0, (y0 + y1) / 2.0, share * height)
            parts.append(slab(f"rail_{rail}_{number}", (length, 0.04, 0.12), at, color, yaw=yaw))
    return assemble(name, parts, pose=pose)
