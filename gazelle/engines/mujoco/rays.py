"""Rays that may pass through shapes of the link that they start from."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.engines.motion import Hits
from gazelle.engines.mujoco.compiler import COLLISION_GROUP
from gazelle.engines.mujoco.running import RunningWorlds
from gazelle.engines.mujoco.shapes import CLOSED_GROUP, OPEN_GROUP
from gazelle.native.ray_frames import met_from_inside

_SEEN = (COLLISION_GROUP, CLOSED_GROUP, OPEN_GROUP)
_GROUPS = np.array([group in _SEEN for group in range(6)], dtype=np.uint8)

# By this rays start beside where they should [m]. MuJoCo's pass between two triangles of a mesh
# if they meet the edge but for single precision, as the middle of a symmetric thing is met.
BESIDE = 3e-6 * np.array([0.613, 0.371, 0.697])
_NOWHERE = np.zeros(3)

# How far behind a surface that is passed through a ray goes on [m].
_BEHIND = 1e-6
_MOST_PASSED = 8


def nearest(
    run: RunningWorlds, start: Floats, along: Floats, worlds: Worlds | None, excluded: int = 0
) -> tuple[Hits, NDArray[np.int32]]:
    """What rays meet first, and which geom it is (-1 for nothing).

    Args:
        run: Worlds that run.
        start: In the world frame, ``beside`` where they should begin [m], shape (n, rays, 3).
        along: Unit vectors, shape (n, rays, 3).
        worlds: Which worlds.
        excluded: A body that rays pass through; the world's, 0, for none.
    """
    distance, geom, normal = run.batch.ray(
        start,
        along,
        geomgroup=_GROUPS,
        bodyexclude=excluded or -1,
        ids=worlds,
        normal=True,
    )
    distance, normal = (np.ascontiguousarray(each, np.float64) for each in (distance, normal))
    geom = np.ascontiguousarray(geom, np.int32)
    # A sheet is met from both sides.
    sheets = run.sheets
    return Hits(distance, met_from_inside(distance, normal, along, geom, sheets)), geom


def beside(run: RunningWorlds) -> Floats:
    """Return by how much rays start beside where they should [m], shape (3,)."""
    return BESIDE if run.compiled.model.nmesh else _NOWHERE


def behind(
    run: RunningWorlds, start: Floats, along: Floats, worlds: Worlds | None, own: Sequence[int]
) -> Hits:
    """What rays meet first that is none of some geoms of the world's body.

    MuJoCo passes through whole bodies only. Rays that meet one of these go on behind it.
    """
    passed = np.zeros(along.shape[:2])
    for _ in range(_MOST_PASSED):
        hits, geom = nearest(run, start + passed[..., None] * along, along, worlds)
        met = np.isin(geom, own)
        if not met.any():
            break
        passed = np.where(met, passed + hits.distance + _BEHIND, passed)
    return Hits(passed + hits.distance, hits.from_inside)
