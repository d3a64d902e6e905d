"""The flag ``--spawn``."""

from __future__ import annotations

import argparse
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from gazelle.description import Pose

if TYPE_CHECKING:
    from gazelle.simulation import Simulation


@dataclass(frozen=True, slots=True)
class SpawnRequest:
    """A robot to spawn.

    Attributes:
        robot: A file or a bundled name.
        pose: Initial pose; None for the origin, or near it if something is there.
    """

    robot: str
    pose: Pose | None = None


def parse_spawn(text: str) -> SpawnRequest:
    """Parse ``ROBOT`` or ``ROBOT@X,Y`` or ``ROBOT@X,Y,YAW`` [m, rad]."""
    robot, at, place = text.rpartition("@")
    if not at:
        return SpawnRequest(text)
    try:
        x, y, yaw = (*map(float, place.split(",")), 0.0)[:3]
    except ValueError:
        x = math.nan
    if not robot or not math.isfinite(x) or place.count(",") > 2:
        raise argparse.ArgumentTypeError(f"expected ROBOT@X,Y or ROBOT@X,Y,YAW, not '{text}'")
    return SpawnRequest(robot, Pose(x, y, yaw=yaw))


def spawn(sim: Simulation, robot: SpawnRequest) -> str:
    """Spawn a robot, beside the origin if something stands there and no pose is given.

    Returns:
        A remark on its place; mostly empty.

    Raises:
        Error: It cannot be loaded or simulated.
    """
    from gazelle import formats
    from gazelle.simulation.free_place import spawn_numbered, spawn_where_free

    model = formats.load_model(robot.robot)
    if robot.pose is not None:
        spawn_numbered(sim, model, robot.pose)
        return ""
    put = spawn_where_free(sim, model)
    if put.stuck:
        return f"'{put.robot.name}' is stuck in something, and there is no room near it"
    if put.moved_to is None:
        return ""
    x, y = put.moved_to
    return f"'{put.robot.name}' starts at {x:g},{y:g}: something stands at the origin"
