"""Models put together from coloured shapes: the material all other builders use."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

from gazelle.argument_checks import checked
from gazelle.builders.errors import BuildError, positive
from gazelle.builders.inertia import solid_inertial
from gazelle.builders.limits import MAX_PARTS
from gazelle.builders.paint import Paint, material
from gazelle.description import (
    Box,
    Collision,
    Cylinder,
    Friction,
    Geometry,
    Link,
    Model,
    Pose,
    Sphere,
    Surface,
    Vector3,
    Visual,
)

ORIGIN = Pose()
"""The pose that leaves things where they are."""


@checked(BuildError)
@dataclass(frozen=True, slots=True)
class Part:
    """One shape of a model.

    Attributes:
        name: Unique among the parts.
        geometry: The shape.
        pose: In the frame of the model.
        color: As ``material`` takes it.
        collides: Whether others can touch it.
        shows: Whether it can be seen.
    """

    name: str
    geometry: Geometry
    pose: Pose = field(default_factory=Pose)
    color: Paint = "grey"
    collides: bool = True
    shows: bool = True


@checked(BuildError)
def slab(
    name: str,
    size: Vector3,
    at: Vector3,
    color: Paint = "grey",
    *,
    yaw: float = 0.0,
    collides: bool = True,
) -> Part:
    """Return a box of ``size`` [m], its centre ``at`` [m], turned about z by ``yaw`` [rad].

    Raises:
        BuildError: A length is not positive.
    """
    for length in size:
        positive(length, f"the size of '{name}'")
    return Part(name, Box(size), Pose(*at, yaw=yaw), color, collides)


@checked(BuildError)
def post(
    name: str,
    radius: float,
    length: float,
    at: Vector3,
    color: Paint = "grey",
    *,
    collides: bool = True,
) -> Part:
    """Return an upright cylinder, its centre ``at`` [m].

    Raises:
        BuildError: The radius or length is not positive.
    """
    positive(radius, f"the radius of '{name}'")
    positive(length, f"the length of '{name}'")
    return Part(name, Cylinder(radius, length), Pose(*at), color, collides)


@checked(BuildError)
def assemble(
    name: str,
    parts: Sequence[Part],
    *,
    pose: Pose = ORIGIN,
    mass: float | None = None,
    friction: float = 1.0,
) -> Model:
    """Return a model of one rigid link.

    Args:
        name: Of the model.
        parts: Its shapes.
        pose: Of the model in the world.
        mass: [kg]; the model can then be moved, with the inertia of its colliding parts at
            one density. None for a model that stands still.
        friction: Coefficient of all its surfaces.

    Raises:
        BuildError: Two parts have one name, a colour is unknown, the pose is not finite, or
            a model with a mass has nothing that collides.
    """
    if len(parts) > MAX_PARTS:
        raise BuildError(f"'{name}' has {len(parts)} parts; the most are {MAX_PARTS}")
    twice, count = next(iter(Counter(part.name for part in parts).most_common(1)), ("", 0))
    if count > 1:
        raise BuildError(f"two parts of '{name}' are called '{twice}'")
    solid = [part for part in parts if part.collides]
    if mass is not None and not solid:
        raise BuildError(f"nothing of '{name}' collides: it would fall for ever")
    link = Link(
        "link",
        inertial=None
        if mass is None
        else solid_inertial([(part.geometry, part.pose) for part in solid], mass),
        collisions=tuple(_collision(part, friction) for part in solid),
        visuals=tuple(_visual(part) for part in parts if part.shows),
    )
    return Model(name, pose=pose, static=mass is None, links=(link,))


def _collision(part: Part, friction: float) -> Collision:
    surface = Surface(Friction(friction, friction))
    return Collision(part.name, part.geometry, part.pose, surface)


def _visual(part: Part) -> Visual:
    # SDF since 1.7 wants all names in a link to differ.
    return Visual(f"{part.name}_visual", part.geometry, part.pose, material(part.color))


@checked(BuildError)
def box(
    name: str = "box",
    size: Vector3 = (0.5, 0.5, 0.5),
    *,
    pose: Pose = ORIGIN,
    mass: float | None = None,
    color: Paint = "beech",
) -> Model:
    """Return a box that stands on its frame's xy plane.

    Args:
        name: Of the model.
        size: Full lengths along x, y, z [m].
        pose: Of the middle of its bottom, in the world.
        mass: [kg]; None for a box that stands still.
        color: As ``material`` takes it.

    Raises:
        BuildError: A length or the mass is not positive.
    """
    part = slab("box", size, (0.0, 0.0, size[2] / 2.0), color)
    return assemble(name, (part,), pose=pose, mass=mass)


@checked(BuildError)
def cylinder(
    name: str = "cylinder",
    radius: float = 0.25,
    length: float = 0.6,
    *,
    pose: Pose = ORIGIN,
    mass: float | None = None,
    color: Paint = "orange",
) -> Model:
    """Return an upright cylinder that stands on its frame's xy plane; see ``box``.

    Raises:
        BuildError: The radius, length or mass is not positive.
    """
    part = post("cylinder", radius, length, (0.0, 0.0, length / 2.0), color)
    return assemble(name, (part,), pose=pose, mass=mass)


@checked(BuildError)
def sphere(
    name: str = "sphere",
    radius: float = 0.25,
    *,
    pose: Pose = ORIGIN,
    mass: float | None = None,
    color: Paint = "blue",
) -> Model:
    """Return a sphere that lies on its frame's xy plane; see ``box``.

    Raises:
        BuildError: The radius or mass is not positive.
    """
    positive(radius, "the radius")
    part = Part("sphere", Sphere(radius), Pose(z=radius), color)
    return assemble(name, (part,), pose=pose, mass=mass)
