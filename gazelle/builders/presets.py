"""Whole worlds: an office and a place outdoors. Same seed, same world."""

from __future__ import annotations

import math
from collections.abc import Sequence

from gazelle.argument_checks import checked
from gazelle.builders.errors import BuildError
from gazelle.builders.furniture import (
    cabinet,
    chair,
    desk,
    office_chair,
    round_table,
    shelf,
    sofa,
    table,
    whiteboard,
)
from gazelle.builders.land import hills
from gazelle.builders.nature import log, plant
from gazelle.builders.obstacles import PlantKind
from gazelle.builders.placing import Disc, Rectangle, along
from gazelle.builders.structures import building, fence
from gazelle.builders.walling import Opening, Point, door, window
from gazelle.builders.world import WorldBuilder
from gazelle.description import Pose, World
from gazelle.streams import Stream

_WALL = 0.15
_HEIGHT = 2.6
_QUARTER = math.pi / 2.0


@checked(BuildError)
def office(
    *,
    seed: int = 0,
    desks: int = 8,
    clutter: int = 5,
    movable: bool = False,
    name: str = "office",
) -> World:
    """Return a floor of offices: desks in pairs, a meeting room, a corner with sofas, and clutter.

    It is 14 m by 10 m, open above. The origin, where a robot may start, is free within a
    metre, and so is the way to the door at -y.

    Args:
        seed: Decides how chairs stand, what colours things have, and where boxes lie.
        desks: From 0 to 8.
        clutter: Number of boxes on the floor.
        movable: Whether chairs and boxes can be pushed.
        name: Of the world.

    Raises:
        BuildError: There is no room for this number of desks or boxes.
    """
    if not 0 <= desks <= 8:
        raise BuildError(f"the office has room for 0 to 8 desks, not {desks}")
    builder = WorldBuilder(name, seed=seed).ground(color="grey").sun(brightness=0.55)
    builder.scene(ambient=(0.55, 0.55, 0.57, 1.0), background=(0.85, 0.88, 0.92, 1.0))
    builder.camera((-5.2, -10.2, 8.6), (0.2, 0.0, 0.3))
    builder.lamp(-3.4, 0.0, z=2.5, brightness=0.3).lamp(4.4, 0.5, z=2.5, brightness=0.3)
    _office_shell(builder)
    stream = Stream(seed, "builders.office", 1)
    _office_desks(builder, desks, stream, movable=movable)
    _meeting_room(builder, stream, movable=movable)
    _lounge(builder)
    builder.keep_clear(Disc(0.0, 0.0, 1.0), Rectangle(0.0, -2.5, 1.6, 5.0))
    builder.obstacles(
        clutter,
        area=Rectangle(-1.6, -0.4, 10.4, 8.6),
        kinds=("box",),
        radius=(0.2, 0.32),
        height=(0.25, 0.5),
        gap=0.35,
        movable=movable,
        name="carton",
    )
    return builder.build()


def _office_shell(builder: WorldBuilder) -> None:
    holes = [
        door(0, 7.0, width=1.4),
        window(0, 3.2),
        window(0, 10.8),
        window(1, 2.5),
        window(1, 7.4),
    ]
    holes += [window(2, 2.6 + 2.9 * i, width=2.0) for i in range(4)]
    holes += [window(3, 2.8, width=1.8), window(3, 7.2, width=1.8)]
    builder.floor(size=(14.0, 10.0), color="carpet")
    builder.room(14.0, 10.0, height=_HEIGHT, openings=_shifted(holes), color="plaster")
    # The meeting room, in the corner at +x, +y.
    inner: tuple[Point, ...] = ((2.4, 5.0), (2.4, 0.6), (7.0, 0.6))
    glass = [
        door(0, 3.4, width=1.0),
        window(0, 1.6, width=1.8, bottom=0.5, top=2.2),
        window(1, 2.3, width=3.2, bottom=0.5, top=2.2),
    ]
    builder.walls(
        inner, name="partition", height=_HEIGHT, thickness=0.1, openings=glass, color="cream"
    )
    builder.floor(name="rug", size=(4.4, 4.2), pose=Pose(4.72, 2.85, 0.002), color="oak")


def _shifted(holes: list[Opening]) -> list[Opening]:
    """Return openings relative to the wall's middle, from those relative to its inner corner."""
    return [Opening(h.wall, h.at + _WALL / 2.0, h.width, h.bottom, h.top) for h in holes]


def _office_desks(builder: WorldBuilder, count: int, stream: Stream, *, movable: bool) -> None:
    """Add pairs of desks face to face, in two blocks along the windows, and shelves."""
    seats = [
        (x + side * 0.42, y, 0.0 if side < 0 else math.pi)
        for y in (3.6, 1.9)
        for x in (-4.6, -1.2)
        for side in (-1.0, 1.0)
    ]
    paints = ("slate", "blue", "green", "black")
    for x, y, yaw in seats[:count]:
        out, aside, turn, paint = stream.uniform(4)[0].tolist()
        builder.place(desk, x, y, yaw, width=1.5)
        seat = Pose(x, y, yaw=yaw) * Pose(-0.58 - 0.3 * out, 0.3 * (aside - 0.5))
        builder.place(
            office_chair,
            seat.x,
            seat.y,
            yaw + 1.4 * (turn - 0.5),
            movable=movable,
            color=paints[int(4 * paint)],
        )
    for x in (-6.1, -5.15):
        builder.place(shelf, x, -4.8, _QUARTER)
    builder.place(cabinet, -6.6, -0.2).place(cabinet, -6.6, 0.3)
    builder.place(plant, -6.6, 4.6, height=1.4).place(plant, 1.9, 4.6, height=1.2)


def _meeting_room(builder: WorldBuilder, stream: Stream, *, movable: bool) -> None:
    builder.place(table, 4.8, 2.8, length=2.6, width=1.1, color="walnut")
    builder.place(whiteboard, 6.97, 2.8, math.pi)
    for x in (4.0, 4.8, 5.6):
        for side in (-1.0, 1.0):
            turn, out = (stream.uniform(2)[0] - 0.5).tolist()
            builder.place(
                chair,
                x,
                2.8 + side * (0.82 + 0.12 * out),
                -side * _QUARTER + 0.4 * turn,
                movable=movable,
            )
    builder.place(plant, 6.6, 4.6, height=1.3)


def _lounge(builder: WorldBuilder) -> None:
    builder.place(sofa, 5.2, -4.45, _QUARTER).place(sofa, 6.4, -2.5, math.pi, color="slate")
    builder.place(round_table, 4.9, -2.7, radius=0.45)
    builder.place(plant, 6.55, -4.55, height=1.5, pot="white")
    builder.place(shelf, 3.1, -4.8, _QUARTER, height=1.2, boards=4)


@checked(BuildError)
def outdoor(
    *,
    seed: int = 0,
    trees: int = 22,
    houses: int = 4,
    rocks: int = 8,
    relief: float = 5.0,
    kinds: Sequence[PlantKind] = ("broadleaf", "conifer", "conifer", "poplar"),
    name: str = "outdoor",
) -> World:
    """Return a road with houses, trees and rocks on a meadow, and hills around it.

    It is 80 m by 80 m. The origin lies on the road, and is free within 4 m.

    Args:
        seed: Decides everything but the road.
        trees: Number of trees.
        houses: From 0 to 6.
        rocks: Number of rocks and bushes, each.
        relief: Height of the highest hills [m]; 0 for flat land.
        kinds: Allowed kinds of trees; a kind named twice is twice as frequent.
        name: Of the world.

    Raises:
        BuildError: There is no room for all that.
    """
    if not 0 <= houses <= len(_PLOTS):
        raise BuildError(f"there is room for 0 to {len(_PLOTS)} houses, not {houses}")
    builder = WorldBuilder(name, seed=seed).ground(color="meadow", size=(400.0, 400.0))
    builder.sun(elevation=math.radians(42.0), brightness=0.75)
    builder.scene(sky=True, ambient=(0.42, 0.44, 0.48, 1.0), background=(0.7, 0.8, 0.9, 1.0))
    builder.camera((-24.0, -27.0, 15.0), (2.0, 2.0, 0.0)).earth(48.137, 11.575, 519.0)
    street = ((-60.0, -5.0), (-14.0, 0.0), (14.0, 0.0), (60.0, 9.0))
    if relief > 0.0:
        flat = [Rectangle(0.0, 0.0, 44.0, 34.0), *along(street, 10.0)]
        land = hills(
            seed,
            length=80.0,
            width=80.0,
            cell=2.5,
            height=relief,
            spacing=20.0,
            flat=flat,
            blend=10.0,
        )
        builder.terrain(land, above=0.02, color=_grassy)
    builder.road(street)
    builder.keep_clear(Disc(0.0, 0.0, 4.0))
    _houses(builder, houses, Stream(seed, "builders.outdoor", 1))
    area = Rectangle(0.0, 0.0, 74.0, 74.0)
    builder.place(log, -6.0, -6.5, 0.5)
    builder.plants(trees, area=area, kinds=kinds)
    builder.plants(rocks, area=area, kinds=("rock",), height=(0.4, 1.4), name="rock")
    builder.plants(rocks, area=area, kinds=("bush",), height=(0.5, 1.1), name="bush")
    return builder.build()


_PLOTS = ((-9.0, 10.0), (8.0, 11.0), (-2.0, -12.5), (16.0, -11.5), (-18.0, -13.0), (20.0, 12.5))


def _houses(builder: WorldBuilder, count: int, stream: Stream) -> None:
    walls_of = ("brick", "cream", "plaster", "sand", "clay")
    for x, y in _PLOTS[:count]:
        paint, storeys, turn, flat = stream.uniform(4)[0].tolist()
        yaw = (0.0 if y > 0 else math.pi) + 0.2 * (turn - 0.5)
        pitched = flat < 0.75
        builder.place(
            building,
            x,
            y,
            yaw,
            length=8.0,
            width=6.5,
            storeys=1 + int(2 * storeys),
            pitched=pitched,
            color=walls_of[int(5 * paint)],
            roof="roof" if pitched else "concrete",
        )
    if count:
        builder.add(fence(((-15.0, 5.0), (-15.0, 15.0), (-3.0, 15.0))))


def _grassy(height: float) -> tuple[float, float, float]:
    """Return the colour at a height: meadow below, drier and stonier above."""
    share = min(max(height / 5.0, 0.0), 1.0)
    low, high = (0.45, 0.58, 0.29), (0.53, 0.51, 0.38)
    red, green, blue = (a + share * (b - a) for a, b in zip(low, high, strict=True))
    return (round(red, 3), round(green, 3), round(blue, 3))
