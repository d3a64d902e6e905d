"""Robots and models that are opened where a world is meant."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from gazelle.description import Heightmap, Model, Plane, Pose, World
from gazelle.formats.loader import PathLike, load
from gazelle.formats.lowest_point import lowest_point

_EMPTY = "empty"
"""The bundled world that robots open in: Gazebo's ``empty.world``."""


def open_world(source: World | Model | PathLike, *, ground: bool = True) -> World:
    """Return the world to simulate for whatever a user names.

    A robot or model, given by its file or description, opens in a world with ground and sun. It
    stands on the ground, with the lowest point of its collisions at z = 0, unless it is fixed to
    the world, or its file puts it above the ground. A world stays as it is.

    Args:
        source: A world or model description, or all that ``load`` takes.
        ground: Whether robots and models get the ground and the sun.

    Raises:
        FormatError: The file cannot be read.
        ResolveError: There is no such file.
    """
    if isinstance(source, World):
        return source
    if isinstance(source, Model):
        world = World(models=(source,), source=source.source, bare=True)
    else:
        world = load(source)
    return on_ground(world) if world.bare and ground else world


def on_ground(world: World) -> World:
    """Return a world with ground and sun that the models of another stand in."""
    empty = load(_EMPTY)
    floor = () if any(map(_is_ground, world.models)) else empty.models
    return replace(
        empty,
        models=(*floor, *(_standing(world.models) if floor else world.models)),
        lights=world.lights or empty.lights,
        source=world.source,
    )


def _standing(models: tuple[Model, ...]) -> Iterator[Model]:
    """Yield models of one file, all moved by what puts the lowest of them onto the ground."""
    low = math.inf
    if not any(map(_is_fixed, models)):
        low = min(map(lowest_point, models), default=math.inf)
    in_the_air = low > 0.0 and any(model.pose.z > 0.0 for model in models)
    lift = 0.0 if in_the_air or not math.isfinite(low) else -low
    for model in models:
        x, y, z = model.pose.position
        pose = Pose.exactly((x, y, z + lift), model.pose.quaternion)
        yield replace(model, pose=pose) if lift else model


def _is_fixed(model: Model) -> bool:
    """Return whether a model does not move, or a joint holds it to the world."""
    ends = ((joint.parent, joint.child) for each in model.walk() for joint in each.model.joints)
    return model.static or any("world" in pair for pair in ends)


def _is_ground(model: Model) -> bool:
    """Return whether a model has a floor of its own."""
    return any(
        isinstance(collision.geometry, Plane | Heightmap)
        for placed in model.walk()
        for link in placed.model.links
        for collision in link.collisions
    )
