"""Trees, bushes and rocks. Each stands on its frame's xy plane, around its origin."""

from __future__ import annotations

from typing import Literal, get_args

from gazelle.argument_checks import checked
from gazelle.builders.errors import BuildError, positive
from gazelle.builders.paint import Paint
from gazelle.builders.solids import ORIGIN, Part, assemble, post, slab
from gazelle.description import Box, Cone, Cylinder, Ellipsoid, Model, Pose, Sphere
from gazelle.errors import did_you_mean

TreeKind = Literal["broadleaf", "conifer", "poplar"]


@checked(BuildError)
def tree(
    name: str = "tree",
    *,
    kind: TreeKind = "broadleaf",
    height: float = 6.0,
    pose: Pose = ORIGIN,
    color: Paint | None = None,
) -> Model:
    """Return a tree, which stands still. Trunk and crown collide.

    Args:
        name: Of the model.
        kind: Shape of the crown.
        height: To its top [m].
        pose: Of the foot of the trunk, in the world.
        color: Of the crown; None for what is usual.

    Raises:
        BuildError: The kind is unknown, or the height is not positive.
    """
    positive(height, "the height of a tree")
    if kind not in _CROWNS:
        raise BuildError(f"unknown tree '{kind}'", hint=did_you_mean(kind, get_args(TreeKind)))
    crown = _CROWNS[kind](height, color)
    trunk = {"broadleaf": 0.45, "conifer": 0.2, "poplar": 0.2}[kind] * height
    # The trunk goes a little into the ground, so that it stands on slopes too.
    sunk = 0.05 * height
    stem = post("trunk", 0.028 * height, trunk + sunk, (0.0, 0.0, (trunk - sunk) / 2.0), "bark")
    return assemble(name, (stem, *crown), pose=pose)


def _broadleaf(height: float, color: Paint | None) -> list[Part]:
    paint = color or "leaf"
    lumps = (
        ("crown", (0.0, 0.0, 0.68), 0.31),
        ("crown_left", (0.03, 0.19, 0.58), 0.2),
        ("crown_right", (-0.13, -0.15, 0.6), 0.22),
        ("crown_front", (0.17, -0.08, 0.62), 0.2),
    )
    return [
        Part(name, Sphere(radius * height), Pose(*(height * value for value in at)), paint)
        for name, at, radius in lumps
    ]


def _conifer(height: float, color: Paint | None) -> list[Part]:
    paint = color or "needle"
    tiers = ((0.14, 0.46, 0.24), (0.36, 0.40, 0.19), (0.58, 0.42, 0.14))
    return [
        Part(
            f"crown_{number}",
            Cone(radius * height, length * height),
            Pose(z=(bottom + length / 2.0) * height),
            paint,
        )
        for number, (bottom, length, radius) in enumerate(tiers)
    ]


def _poplar(height: float, color: Paint | None) -> list[Part]:
    radii = (0.14 * height, 0.14 * height, 0.43 * height)
    return [Part("crown", Ellipsoid(radii), Pose(z=0.57 * height), color or "green")]


_CROWNS = {"broadleaf": _broadleaf, "conifer": _conifer, "poplar": _poplar}


@checked(BuildError)
def bush(
    name: str = "bush", *, height: float = 0.9, pose: Pose = ORIGIN, color: Paint = "leaf"
) -> Model:
    """Return a bush.

    Raises:
        BuildError: The height is not positive.
    """
    positive(height, "the height of a bush")
    parts = [
        Part(
            "left",
            Ellipsoid((0.5 * height, 0.45 * height, 0.5 * height)),
            Pose(y=0.2 * height, z=0.42 * height),
            color,
        ),
        Part(
            "right",
            Ellipsoid((0.42 * height, 0.45 * height, 0.4 * height)),
            Pose(x=0.15 * height, y=-0.3 * height, z=0.34 * height),
            color,
        ),
    ]
    return assemble(name, parts, pose=pose)


@checked(BuildError)
def rock(
    name: str = "rock", *, size: float = 0.8, pose: Pose = ORIGIN, color: Paint = "rock"
) -> Model:
    """Return a boulder, about ``size`` [m] across, partly in the ground.

    Raises:
        BuildError: The size is not positive.
    """
    positive(size, "the size of a rock")
    parts = [
        Part("body", Ellipsoid((0.5 * size, 0.4 * size, 0.32 * size)), Pose(z=0.16 * size), color),
        Part(
            "edge",
            Box((0.5 * size, 0.42 * size, 0.4 * size)),
            Pose(0.08 * size, 0.05 * size, 0.14 * size, 0.25, -0.3, 0.6),
            color,
        ),
    ]
    return assemble(name, parts, pose=pose)


@checked(BuildError)
def plant(
    name: str = "plant", *, height: float = 1.1, pose: Pose = ORIGIN, pot: Paint = "clay"
) -> Model:
    """Return a plant in a pot, for indoors.

    Raises:
        BuildError: The height is not positive.
    """
    positive(height, "the height of a plant")
    parts = [
        post("pot", 0.15 * height, 0.28 * height, (0.0, 0.0, 0.14 * height), pot),
        Part("stem", Cylinder(0.02 * height, 0.3 * height), Pose(z=0.4 * height), "bark"),
        Part("leaves", Ellipsoid((0.24 * height, 0.22 * height, 0.3 * height)),
             Pose(z=0.7 * height), "leaf"),
        Part("leaves_low", Ellipsoid((0.2 * height, 0.24 * height, 0.16 * height)),
             Pose(0.05 * height, -0.04 * height, 0.5 * height), "green"),
    ]  # fmt: skip
    return assemble(name, parts, pose=pose)


@checked(BuildError)
def log(
    name: str = "log", *, length: float = 2.5, radius: float = 0.18, pose: Pose = ORIGIN
) -> Model:
    """Return a felled trunk along x.

    Raises:
        BuildError: The length or radius is not positive.
    """
    positive(length, "the length of a log")
    positive(radius, "the radius of a log")
    parts = (
        Part("trunk", Cylinder(radius, length), Pose(z=radius, pitch=1.5707963267948966), "bark"),
        slab("branch", (0.06, 0.5, 0.06), (0.2 * length, 0.25 + 0.5 * radius, radius), "bark"),
    )
    return assemble(name, parts, pose=pose)
