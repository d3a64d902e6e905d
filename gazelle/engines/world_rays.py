"""Rays in the world frame."""

from __future__ import annotations

from gazelle.array_types import Floats, Worlds
from gazelle.engines.engine import Engine
from gazelle.engines.motion import Hits
from gazelle.rotations import conjugate, rotate


def cast_in_world(
    engine: Engine, link: str, origins: Floats, directions: Floats, world: Worlds
) -> Hits:
    """Cast rays of one world to the nearest collision shape.

    Args:
        engine: Any.
        link: Scoped name of a link, which carries the rays.
        origins: In the world frame [m], shape (rays, 3).
        directions: Unit vectors, likewise.
        world: Number of the world, shape (1,).

    Raises:
        EngineError: The engine has no such rays: the plane has rays of one height only.
    """
    row = engine.links[link]
    place = row.placement(world)
    back = conjugate(place.quaternion[0])
    return row.cast_rays(rotate(back, origins - place.position[0]), rotate(back, directions), world)
