"""Where ``--spawn`` puts a robot, and what it is called."""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from gazelle.description import Plane, Pose
from gazelle.errors import EngineError

if TYPE_CHECKING:
    from gazelle.description import Model
    from gazelle.simulation import Robot, Simulation

_RING_M = 0.5
_FARTHEST_M = 5.0
# What sinks deeper than this into something is in its place [m]; into what it stands on it may sink more.
_TOUCH_M = 0.002
_SINK_M = 0.05
_UPWARD = 0.7


@dataclass(frozen=True, slots=True)
class Wanted:
    """A robot to spawn.

    Attributes:
        robot: A file or a bundled name.
        pose: Where; None for the origin, or near it if something is there.
    """

    robot: str
    pose: Pose | None = None


def wanted(text: str) -> Wanted:
    """``ROBOT`` or ``ROBOT@X,Y`` or ``ROBOT@X,Y,YAW`` [m, rad]."""
    robot, at, place = text.rpartition("@")
    if not at:
        return Wanted(text)
    try:
        x, y, yaw = (*map(float, place.split(",")), 0.0)[:3]
    except ValueError:
        x = math.nan
    if not robot or not math.isfinite(x) or place.count(",") > 2:
        raise argparse.ArgumentTypeError(f"expected ROBOT@X,Y or ROBOT@X,Y,YAW, not '{text}'")
    return Wanted(robot, Pose(x, y, yaw=yaw))


def spawn(sim: Simulation, robot: Wanted) -> str:
    """Put a robot into a simulation.

    The second of a name gets a number behind it, and topics of its own under that.

    Returns:
        What there is to say about its place; mostly nothing.

    Raises:
        Error: It cannot be loaded or simulated.
    """
    from gazelle import formats

    model = formats.load_model(robot.robot)
    name = _free_name(model.name, sim)
    namespace = "/" if name == model.name else f"/{name}"
    model = replace(model, name=name)
    put = sim.spawn(model, pose=robot.pose, namespace=namespace)
    if robot.pose is not None or not _stuck(sim, put):
        return ""
    return _move(sim, put, model)


def _free_name(name: str, sim: Simulation) -> str:
    taken = {model.name for model in sim.world.models}
    number = 1
    free = name
    while free in taken:
        number += 1
        free = f"{name}_{number}"
    return free


def _move(sim: Simulation, robot: Robot, model: Model) -> str:
    """Spawn it again at the nearest place that is free, if there is one."""
    for x, y in _rings():
        there = _at(model.pose, x, y)
        robot.set_pose(there.position, there.quaternion)
        if not _stuck(sim, robot):
            namespace = robot.namespace
            sim.delete(model.name)
            # Resets put it back to where it was spawned.
            sim.spawn(replace(model, pose=Pose()), pose=there, namespace=namespace)
            return f"'{model.name}' starts at {x:g},{y:g}: something stands at the origin"
    robot.set_pose(model.pose.position, model.pose.quaternion)
    return f"'{model.name}' is stuck in something, and there is no room near it"


def _at(pose: Pose, x: float, y: float) -> Pose:
    return Pose.from_quaternion((x, y, pose.position[2]), pose.quaternion)


def _rings() -> Iterator[tuple[float, float]]:
    """Places around the origin, the nearest first."""
    for ring in range(1, round(_FARTHEST_M / _RING_M) + 1):
        for corner in range(8 * ring):
            turn = 2.0 * math.pi * corner / (8 * ring)
            radius = ring * _RING_M
            yield round(radius * math.cos(turn), 2), round(radius * math.sin(turn), 2)


def _stuck(sim: Simulation, robot: Robot) -> bool:
    """Whether a robot and something else are at the same place."""
    own = [
        f"{robot.name}::{link.name}::{collision.name}"
        for link in robot.description.links
        for collision in link.collisions
    ]
    try:
        found = sim.engine.contacts(own)
    except EngineError:  # an engine that knows none
        return False
    grounds = _planes(sim)
    touching = zip(found.others, found.depth, found.normal, strict=True)
    return any(
        depth > (_SINK_M if normal[2] > _UPWARD else _TOUCH_M)
        for other, depth, normal in touching
        if other not in grounds and not other.startswith(f"{robot.name}::")
    )


def _planes(sim: Simulation) -> set[str]:
    """The collisions that are infinite planes: a robot may stand in them up to its middle."""
    return {
        f"{model.name}::{link.name}::{collision.name}"
        for model in sim.world.models
        for link in model.links
        for collision in link.collisions
        if isinstance(collision.geometry, Plane)
    }
