"""Lights of a running world."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

from gazelle.description import Light, World
from gazelle.errors import SimulationError, did_you_mean


def with_light(world: World, name: str, changes: dict[str, Any]) -> World:
    """Return the world with fields of one of its lights replaced.

    Raises:
        SimulationError: There is no such light, or no such field.
    """
    known = [light.name for light in world.lights]
    if name not in known:
        raise SimulationError(f"there is no light '{name}'", hint=did_you_mean(name, known))
    allowed = [field.name for field in fields(Light)]
    for field in changes:
        if field not in allowed:
            raise SimulationError(f"a light has no '{field}'", hint=did_you_mean(field, allowed))
    lights = tuple(
        replace(light, **changes) if light.name == name else light for light in world.lights
    )
    return replace(world, lights=lights)
