"""Ground, floors and light."""

from __future__ import annotations

import math

from gazelle.argument_checks import checked
from gazelle.builders.errors import BuildError, positive
from gazelle.builders.paint import Paint, material
from gazelle.builders.solids import ORIGIN, assemble, slab
from gazelle.description import (
    Attenuation,
    Collision,
    Color,
    Friction,
    Light,
    Link,
    Model,
    Plane,
    Pose,
    Surface,
    Visual,
)

_SUN_DISTANCE = 100.0  # where the sun's frame is drawn; its rays come from infinity [m]
_FLOOR = 0.004  # thickness of a floor [m]


@checked(BuildError)
def ground(
    name: str = "ground_plane",
    *,
    size: tuple[float, float] = (100.0, 100.0),
    friction: float = 100.0,
    color: Paint = "light grey",
) -> Model:
    """Return the ground: an endless plane at z = 0, of which ``size`` [m] shows.

    The default friction is that of Gazebo's ground plane: high, so that the friction of
    what stands on it counts.

    Raises:
        BuildError: A length is not positive.
    """
    for length in size:
        positive(length, "the size of the ground")
    plane = Plane(size=size)
    link = Link(
        "link",
        collisions=(Collision("ground", plane, surface=Surface(Friction(friction, friction))),),
        visuals=(Visual("ground_visual", plane, material=material(color), cast_shadows=False),),
    )
    return Model(name, static=True, links=(link,))


@checked(BuildError)
def floor(
    name: str = "floor",
    *,
    size: tuple[float, float] = (10.0, 8.0),
    pose: Pose = ORIGIN,
    color: Paint = "carpet",
) -> Model:
    """Return a floor covering: it shows, 4 mm above the ground, and touches nothing.

    Raises:
        BuildError: A length is not positive.
    """
    part = slab("floor", (*size, _FLOOR), (0.0, 0.0, _FLOOR / 2.0), color, collides=False)
    return assemble(name, (part,), pose=pose)


@checked(BuildError)
def sun(
    name: str = "sun",
    *,
    elevation: float = math.radians(55.0),
    azimuth: float = math.radians(215.0),
    brightness: float = 0.8,
) -> Light:
    """Return a sun that throws shadows.

    Args:
        name: Of the light.
        elevation: Above the horizon [rad].
        azimuth: Direction of the sun, counter-clockwise from x [rad].
        brightness: Of its white light, 0 to 1.

    Raises:
        BuildError: The sun is not above the horizon, or the brightness is out of range.
    """
    if not 0.0 < elevation <= math.pi / 2:
        raise BuildError(f"the sun must stand above the horizon, found {elevation:g} rad")
    level = math.cos(elevation)
    towards = (level * math.cos(azimuth), level * math.sin(azimuth), math.sin(elevation))
    x, y, z = towards
    return Light(
        name,
        "directional",
        pose=Pose(*(_SUN_DISTANCE * value for value in towards)),
        diffuse=_white(brightness),
        specular=(0.2, 0.2, 0.2, 1.0),
        direction=(-x, -y, -z),
        attenuation=Attenuation(1000.0, 0.9, 0.01, 0.001),
        cast_shadows=True,
    )


@checked(BuildError)
def lamp(
    name: str = "lamp",
    *,
    x: float = 0.0,
    y: float = 0.0,
    z: float = 2.5,
    reach: float = 8.0,
    brightness: float = 0.5,
    cast_shadows: bool = False,
) -> Light:
    """Return a lamp at a point [m]; its light ends at ``reach`` [m].

    Raises:
        BuildError: The reach is not positive, or the brightness is out of range.
    """
    positive(reach, "the reach of a lamp")
    return Light(
        name,
        "point",
        pose=Pose(x, y, z),
        diffuse=_white(brightness),
        attenuation=Attenuation(reach, 0.6, 0.1, 0.05),
        cast_shadows=cast_shadows,
    )


def _white(brightness: float) -> Color:
    if not 0.0 <= brightness <= 1.0:
        raise BuildError(f"a brightness is from 0 to 1, found {brightness:g}")
    return (brightness, brightness, brightness, 1.0)
