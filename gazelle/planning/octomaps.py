"""Octrees as objects of a planning scene."""

from __future__ import annotations

from typing import Final

import numpy as np

from gazelle.argument_checks import checked
from gazelle.description import Box, Pose
from gazelle.errors import PlanningError
from gazelle.formats import Octree
from gazelle.planning.scene_objects import SceneObject

OCTOMAP: Final = "<octomap>"
"""MoveIt's name of a scene's octomap, also for what may touch it."""

_MOST_BOXES: Final = 50_000
"""All of them are looked at for each state, so more would make plans slow."""


@checked(PlanningError)
def octree_object(octree: Octree, pose: Pose | None = None, name: str = OCTOMAP) -> SceneObject:
    """Return the occupied space of an octree, as boxes.

    Args:
        octree: The map.
        pose: Of its frame, in the robot's.
        name: Of the object.

    Raises:
        FormatError: The octree cannot be read.
        PlanningError: It has more than 50,000 boxes, or is infinitely far away.
    """
    at = Pose() if pose is None else pose
    middles, edges = octree.cuboids()
    if not np.isfinite([*at.position, *at.quaternion]).all() or not np.isfinite(middles).all():
        raise PlanningError(f"the pose or the resolution of the octree '{name}' is not finite")
    if len(middles) > _MOST_BOXES:
        raise PlanningError(
            f"the octree '{name}' has {len(middles):,} boxes, more than {_MOST_BOXES:,}",
            hint="make it coarser, or send the part around the robot",
        )
    shapes = tuple(
        (Box((a, b, c)), Pose(x, y, z))
        for (x, y, z), (a, b, c) in zip(middles.tolist(), edges.tolist(), strict=True)
    )
    return SceneObject(name, shapes, at, octree=octree)
