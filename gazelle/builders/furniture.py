"""Furniture, to scale. Each stands on its frame's xy plane, around its origin.

A user looks along +x: a chair's sitter, a desk's worker (who sits at its -x side).
With ``movable`` a thing can be pushed, and weighs what such a thing weighs.
"""

from __future__ import annotations

import math

from gazelle.argument_checks import checked
from gazelle.builders.errors import BuildError, positive
from gazelle.builders.limits import MAX_PARTS
from gazelle.builders.paint import Paint
from gazelle.builders.solids import ORIGIN, Part, assemble, post, slab
from gazelle.description import Box, Model, Pose

_TOP = 0.03  # thickness of boards [m]
_LEG = 0.05  # width of legs [m]
_CORNERS = ((1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0))


@checked(BuildError)
def desk(
    name: str = "desk",
    *,
    pose: Pose = ORIGIN,
    length: float = 0.8,
    width: float = 1.6,
    height: float = 0.74,
    screen: bool = True,
    movable: bool = False,
    color: Paint = "oak",
) -> Model:
    """Return a desk with a cabinet and, if ``screen``, a screen and a keyboard; 38 kg if movable.

    Args:
        name: Of the model.
        pose: In the world.
        length: Depth, along x [m].
        width: Along y [m].
        height: [m].
        screen: Whether it is a workplace.
        movable: Whether it can be pushed.
        color: Of the top.

    Raises:
        BuildError: A length is too small.
    """
    parts = _board_on_legs(length, width, height, color, "steel")
    cabinet = (length * 0.75, 0.4, height - _TOP - 0.08)
    parts.append(
        slab(
            "cabinet",
            cabinet,
            (0.0, width / 2.0 - 0.3, height - _TOP - cabinet[2] / 2.0),
            "light grey",
        )
    )
    if screen:
        parts += _workplace(length, height)
    return assemble(name, parts, pose=pose, mass=38.0 if movable else None)


def _workplace(length: float, height: float) -> list[Part]:
    x = length * 0.22
    return [
        slab("screen_foot", (0.18, 0.24, 0.01), (x, 0.0, height + 0.005), "black"),
        slab("screen_neck", (0.03, 0.05, 0.16), (x + 0.03, 0.0, height + 0.09), "black"),
        slab("screen", (0.025, 0.56, 0.34), (x, 0.0, height + 0.32), "black"),
        slab("picture", (0.004, 0.53, 0.31), (x - 0.013, 0.0, height + 0.32), "blue"),
        slab("keyboard", (0.13, 0.42, 0.02), (-0.12, 0.0, height + 0.01), "slate"),
    ]


@checked(BuildError)
def table(
    name: str = "table",
    *,
    pose: Pose = ORIGIN,
    length: float = 1.4,
    width: float = 0.8,
    height: float = 0.74,
    movable: bool = False,
    color: Paint = "beech",
) -> Model:
    """Return a table with four legs; 24 kg if movable. Arguments are those of ``desk``.

    Raises:
        BuildError: A length is too small.
    """
    parts = _board_on_legs(length, width, height, color, color)
    return assemble(name, parts, pose=pose, mass=24.0 if movable else None)


@checked(BuildError)
def round_table(
    name: str = "round_table",
    *,
    pose: Pose = ORIGIN,
    radius: float = 0.5,
    height: float = 0.74,
    movable: bool = False,
    color: Paint = "white",
) -> Model:
    """Return a round table on one leg; 20 kg if movable.

    Raises:
        BuildError: The radius or height is not positive.
    """
    leg = height - _TOP - 0.03
    positive(leg, "the height of the leg")
    parts = [
        post("top", radius, _TOP, (0.0, 0.0, height - _TOP / 2.0), color),
        post("leg", 0.045, leg, (0.0, 0.0, 0.03 + leg / 2.0), "steel"),
        slab("foot_x", (radius * 1.2, 0.08, 0.03), (0.0, 0.0, 0.015), "steel"),
        slab("foot_y", (0.08, radius * 1.2, 0.03), (0.0, 0.0, 0.015), "steel"),
    ]
    return assemble(name, parts, pose=pose, mass=20.0 if movable else None)


def _board_on_legs(
    length: float, width: float, height: float, board: Paint, legs: Paint
) -> list[Part]:
    under = height - _TOP
    if min(length, width) < 3.0 * _LEG or under <= 0.0:
        raise BuildError(
            f"a table of {length:g} m x {width:g} m x {height:g} m has no room for its legs"
        )
    parts = [slab("top", (length, width, _TOP), (0.0, 0.0, height - _TOP / 2.0), board)]
    x, y = length / 2.0 - _LEG, width / 2.0 - _LEG
    corners = ((x, y), (x, -y), (-x, y), (-x, -y))
    for number, (at_x, at_y) in enumerate(corners):
        parts.append(slab(f"leg_{number}", (_LEG, _LEG, under), (at_x, at_y, under / 2.0), legs))
    return parts


@checked(BuildError)
def chair(
    name: str = "chair",
    *,
    pose: Pose = ORIGIN,
    movable: bool = False,
    color: Paint = "oak",
) -> Model:
    """Return a wooden chair; 5 kg if movable."""
    parts = [slab("seat", (0.42, 0.42, 0.035), (0.0, 0.0, 0.445), color)]
    for number, (x, y) in enumerate(_CORNERS):
        at = (0.185 * x, 0.185 * y, 0.21375)
        parts.append(slab(f"leg_{number}", (0.035, 0.035, 0.4275), at, "walnut"))
    for side, y in (("left", 0.185), ("right", -0.185)):
        parts.append(slab(f"stile_{side}", (0.03, 0.03, 0.38), (-0.19, y, 0.6525), "walnut"))
    parts += [
        slab("back_low", (0.025, 0.36, 0.07), (-0.19, 0.0, 0.6), color),
        slab("back_high", (0.025, 0.4, 0.14), (-0.19, 0.0, 0.8), color),
    ]
    return assemble(name, parts, pose=pose, mass=5.0 if movable else None)


@checked(BuildError)
def office_chair(
    name: str = "office_chair",
    *,
    pose: Pose = ORIGIN,
    movable: bool = False,
    color: Paint = "slate",
) -> Model:
    """Return an office chair on five feet; 14 kg if movable. Its castors do not turn."""
    parts = [
        slab("seat", (0.48, 0.5, 0.08), (0.0, 0.0, 0.46), color),
        slab("back", (0.06, 0.46, 0.52), (-0.23, 0.0, 0.82), color),
        slab("spine", (0.03, 0.07, 0.16), (-0.245, 0.0, 0.5), "black"),
        post("column", 0.03, 0.32, (0.0, 0.0, 0.26), "steel"),
    ]
    for number in range(5):
        turn = Pose(yaw=2.0 * math.pi * number / 5.0)
        parts += [
            Part(f"foot_{number}", Box((0.27, 0.05, 0.03)), turn * Pose(x=0.15, z=0.085), "black"),
            Part(f"castor_{number}", Box((0.05, 0.04, 0.07)), turn * Pose(x=0.27, z=0.035), "grey"),
        ]
    for side, y in (("left", 0.28), ("right", -0.28)):
        parts += [
            slab(f"arm_{side}", (0.26, 0.05, 0.03), (0.0, y, 0.66), "black"),
            slab(f"arm_post_{side}", (0.04, 0.03, 0.18), (0.0, y, 0.555), "black"),
        ]
    return assemble(name, parts, pose=pose, mass=14.0 if movable else None, friction=0.3)


@checked(BuildError)
def shelf(
    name: str = "shelf",
    *,
    pose: Pose = ORIGIN,
    length: float = 0.32,
    width: float = 0.9,
    height: float = 1.9,
    boards: int = 5,
    books: bool = True,
    movable: bool = False,
    color: Paint = "beech",
) -> Model:
    """Return a shelf, its back at -x and open towards +x; 45 kg if movable.

    Args:
        name: Of the model.
        pose: In the world.
        length: Depth, along x [m].
        width: Along y [m].
        height: [m].
        boards: Number of boards, top and bottom included, at least 2.
        books: Whether books stand on them.
        movable: Whether it can be pushed.
        color: Of the wood.

    Raises:
        BuildError: There are too few boards, or they leave no room between them.
    """
    if not 2 <= boards <= MAX_PARTS or height < boards * 0.1 or width < 0.2 or length < 0.1:
        raise BuildError(f"a shelf {height:g} m high has no room for {boards} boards")
    thick = 0.025
    parts = [slab("back", (0.012, width, height), (0.006 - length / 2.0, 0.0, height / 2.0), color)]
    for side, sign in (("left", 1.0), ("right", -1.0)):
        y = sign * (width - thick) / 2.0
        parts.append(slab(f"side_{side}", (length, thick, height), (0.0, y, height / 2.0), color))
    step = (height - thick) / (boards - 1)
    for number in range(boards):
        z = thick / 2.0 + number * step
        size = (length - 0.012, width - 2.0 * thick, thick)
        parts.append(slab(f"board_{number}", size, (0.006, 0.0, z), color))
        if books and number < boards - 1:
            parts += _books(number, width - 2.0 * thick, z + thick / 2.0, step - thick)
    return assemble(name, parts, pose=pose, mass=45.0 if movable else None)


def _books(row: int, width: float, z: float, room: float) -> list[Part]:
    """Return three blocks of books; they differ from row to row."""
    paints: tuple[Paint, ...] = ("red", "blue", "cream", "green", "walnut", "slate")
    parts = []
    y = -width / 2.0 + 0.02
    for number in range(3):
        share = 0.16 + 0.05 * ((row * 3 + number * 5) % 4)
        height = min(room - 0.02, 0.2 + 0.03 * ((row + number) % 3))
        size = (0.19, share * width, height)
        at = (0.0, y + size[1] / 2.0, z + height / 2.0)
        parts.append(slab(f"books_{row}_{number}", size, at, paints[(row * 2 + number) % 6]))
        y += size[1] + 0.01
    return parts


@checked(BuildError)
def cabinet(
    name: str = "cabinet",
    *,
    pose: Pose = ORIGIN,
    movable: bool = False,
    color: Paint = "light grey",
) -> Model:
    """Return a filing cabinet with four drawers that open towards +x; 35 kg if movable."""
    parts = [slab("body", (0.6, 0.45, 1.3), (0.0, 0.0, 0.65), color)]
    for number in range(4):
        z = 0.18 + 0.315 * number
        parts += [
            slab(f"front_{number}", (0.008, 0.42, 0.29), (0.304, 0.0, z), "grey", collides=False),
            slab(
                f"handle_{number}", (0.02, 0.14, 0.015), (0.318, 0.0, z + 0.08), "steel",
                collides=False,
            ),
        ]  # fmt: skip
    return assemble(name, parts, pose=pose, mass=35.0 if movable else None)


@checked(BuildError)
def sofa(
    name: str = "sofa",
    *,
    pose: Pose = ORIGIN,
    width: float = 1.8,
    movable: bool = False,
    color: Paint = "blue",
) -> Model:
    """Return a sofa, its back at -x; 40 kg if movable.

    Raises:
        BuildError: It is narrower than a metre.
    """
    if width < 1.0:
        raise BuildError(f"a sofa is at least 1 m wide, found {width:g}")
    parts = [
        slab("base", (0.85, width, 0.3), (0.0, 0.0, 0.2), color),
        slab("back", (0.22, width, 0.42), (-0.315, 0.0, 0.56), color),
    ]
    seat = (width - 0.44) / 2.0
    for side, sign in (("left", 1.0), ("right", -1.0)):
        parts += [
            slab(f"arm_{side}", (0.63, 0.2, 0.22), (0.11, sign * (width / 2 - 0.1), 0.46), color),
            slab(f"seat_{side}", (0.6, seat, 0.11), (0.1, sign * seat / 2, 0.405), "light grey"),
            slab(f"foot_{side}", (0.75, 0.08, 0.05), (0.0, sign * (width / 2 - 0.2), 0.025), "black"),
        ]  # fmt: skip
    return assemble(name, parts, pose=pose, mass=40.0 if movable else None)


@checked(BuildError)
def whiteboard(name: str = "whiteboard", *, pose: Pose = ORIGIN, width: float = 1.8) -> Model:
    """Return a whiteboard for a wall, from 0.9 to 2 m high, facing +x.

    Raises:
        BuildError: The width is not positive.
    """
    parts = [
        slab("frame", (0.03, width, 1.1), (0.0, 0.0, 1.45), "steel"),
        slab("board", (0.006, width - 0.05, 1.05), (0.017, 0.0, 1.45), "white"),
    ]
    return assemble(name, parts, pose=pose)
