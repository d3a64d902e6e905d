"""Lights of a running world."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

from gazelle.description import Light, World
from gazelle.errors import SimulationError, did_you_mean
from gazelle.simulation.running_state import RunningState


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


def add_light(simulation: RunningState, light: Light) -> Light:
    """Add a light to a running world; the next picture of a camera shows it.

    Returns:
        The light, under a numbered name where its own is taken.
    """
    with simulation.lock:
        world = simulation.world
        taken = {each.name for each in world.lights}
        name, number = light.name, 1
        while name in taken:
            number += 1
            name = f"{light.name}_{number}"
        added = replace(light, name=name)
        simulation.engine.update_world(replace(world, lights=(*world.lights, added)))
    return added


def delete_light(simulation: RunningState, name: str) -> None:
    """Delete a light of a running world.

    Raises:
        SimulationError: There is no such light.
    """
    with simulation.lock:
        world = with_light(simulation.world, name, {})  # checks the name
        lights = tuple(each for each in world.lights if each.name != name)
        simulation.engine.update_world(replace(world, lights=lights))
