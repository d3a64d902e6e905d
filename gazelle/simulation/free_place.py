"""Spawning at the nearest place where nothing stands."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from gazelle.description import Model, Plane, Pose
from gazelle.errors import EngineError
from gazelle.simulation.robot import Robot
from gazelle.simulation.simulation import Simulation

_RING_M = 0.5
_FARTHEST_M = 5.0
# Penetration up to here is ordinary contact; that of the ground below may be deeper [m].
_TOUCH_M = 0.002
_SINK_M = 0.05
_UPWARD = 0.7


@dataclass(frozen=True, slots=True)
class SpawnedModel:
    """Result of `spawn_where_free`.

    Attributes:
        robot: The spawned model.
        moved_to: Position that was taken instead of the wanted one [m], None if that was free.
        stuck: True if no free place was found, and the model penetrates something.
    """

    robot: Robot
    moved_to: tuple[float, float] | None = None
    stuck: bool = False


def spawn_numbered(simulation: Simulation, model: Model, pose: Pose | None = None) -> Robot:
    """Spawn a model under its name, or under a numbered one where that is taken.

    The second ``burger`` is ``burger_2``, with its topics under ``/burger_2``.

    Args:
        simulation: Any engine.
        model: Model to spawn.
        pose: See `Simulation.spawn`.

    Raises:
        Error: The model cannot be simulated.
    """
    taken = {each.name for each in simulation.world.models}
    name, number = model.name, 1
    while name in taken:
        number += 1
        name = f"{model.name}_{number}"
    namespace = "/" if name == model.name else f"/{name}"
    return simulation.spawn(replace(model, name=name), pose=pose, namespace=namespace)


def spawn_where_free(
    simulation: Simulation, model: Model, pose: Pose | None = None
) -> SpawnedModel:
    """Spawn a model as `spawn_numbered` does, or at the nearest free place around.

    Args:
        simulation: Any engine; one without contacts takes the wanted pose.
        model: Model to spawn.
        pose: See `Simulation.spawn`.

    Raises:
        Error: The model cannot be simulated.
    """
    with simulation.lock:  # contacts are those of a moment, also where another thread steps
        return _spawn_where_free(simulation, model, pose)


def _spawn_where_free(simulation: Simulation, model: Model, pose: Pose | None) -> SpawnedModel:
    """Spawn a model; the caller holds the lock."""
    robot = spawn_numbered(simulation, model, pose)
    if not _penetrates(simulation, robot):
        return SpawnedModel(robot)
    start = (pose or Pose()) * model.pose
    for x, y in _offsets():
        there = _shifted(start, x, y)
        robot.set_pose(there.position, there.quaternion)
        if not _penetrates(simulation, robot):
            # Spawned again there, since a reset returns it to its spawn pose.
            free = replace(model, name=robot.name, pose=Pose())
            simulation.delete(robot.name)
            robot = simulation.spawn(free, pose=there, namespace=robot.namespace)
            return SpawnedModel(robot, moved_to=(there.position[0], there.position[1]))
    robot.set_pose(start.position, start.quaternion)
    return SpawnedModel(robot, stuck=True)


def _shifted(pose: Pose, x: float, y: float) -> Pose:
    at = pose.position
    return Pose.from_quaternion((at[0] + x, at[1] + y, at[2]), pose.quaternion)


def _offsets() -> Iterator[tuple[float, float]]:
    """Yield points of rings around the wanted place, the nearest first [m]."""
    for ring in range(1, round(_FARTHEST_M / _RING_M) + 1):
        for corner in range(8 * ring):
            turn = 2.0 * math.pi * corner / (8 * ring)
            radius = ring * _RING_M
            yield round(radius * math.cos(turn), 2), round(radius * math.sin(turn), 2)


def _penetrates(simulation: Simulation, robot: Robot) -> bool:
    own = [
        f"{robot.name}::{link.name}::{collision.name}"
        for link in robot.description.links
        for collision in link.collisions
    ]
    try:
        found = simulation.engine.contacts([own]).named()
    except EngineError:  # an engine without contacts
        return False
    grounds = _planes(simulation)
    touching = zip(found.others, found.depth, found.normal, strict=True)
    return any(
        depth > (_SINK_M if normal[2] > _UPWARD else _TOUCH_M)
        for other, depth, normal in touching
        if other not in grounds and not other.startswith(f"{robot.name}::")
    )


def _planes(simulation: Simulation) -> set[str]:
    """Return the collisions that are infinite planes, in which a model may stand up to its middle."""
    return {
        f"{model.name}::{link.name}::{collision.name}"
        for model in simulation.world.models
        for link in model.links
        for collision in link.collisions
        if isinstance(collision.geometry, Plane)
    }
