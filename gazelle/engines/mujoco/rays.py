"""Rays fixed to links, which may pass through the shapes of their link."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy

import mujoco
import numpy as np

from gazelle.argument_checks import world_indices
from gazelle.array_types import Floats, Worlds
from gazelle.description import Pose
from gazelle.engines.motion import Hits, Placement
from gazelle.engines.mujoco.compiler.shapes import CLOSED_GROUP, OPEN_GROUP
from gazelle.engines.mujoco.compiler.spec import COLLISION_GROUP
from gazelle.engines.mujoco.library import address_of, address_of_struct
from gazelle.engines.mujoco.ray_system import RaySystem
from gazelle.engines.mujoco.worlds import RunningWorlds
from gazelle.engines.range_rays import RangeRays
from gazelle.errors import EngineError
from gazelle.native.ray_frames import FrameRays
from gazelle.native.system import System

_SEEN = (COLLISION_GROUP, CLOSED_GROUP, OPEN_GROUP)
_GROUPS = np.array([group in _SEEN for group in range(6)], dtype=np.uint8)

# By this rays start beside where they should [m]. MuJoCo's pass between two triangles of a mesh
# if they meet the edge but for single precision, as the middle of a symmetric thing is met.
BESIDE = 3e-6 * np.array([0.613, 0.371, 0.697])
_NOWHERE = np.zeros(3)

_SLEEP = int(mujoco.mjtEnableBit.mjENBL_SLEEP)

# How far behind a surface that is passed through a ray continues [m].
_BEHIND = 1e-6
_MOST_PASSED = 8


def meet(
    run: RunningWorlds,
    rays: FrameRays,
    worlds: Worlds | None,
    excluded: int = 0,
    *,
    signed: bool = False,
) -> None:
    """Find the first hits of rays.

    Args:
        run: Worlds that run.
        rays: Aimed, ``ray_offset`` where they should begin.
        worlds: Worlds.
        excluded: A body that rays pass through; the world's, 0, for none.
        signed: Whether to set distances to minus infinity where something is met from inside.
    """
    if excluded:
        rays.passed.fill(excluded)
    run.batch.meet(rays, _GROUPS, worlds)
    rays.settle(run.sheets, signed=signed)  # a sheet is met from both sides


def ray_offset(run: RunningWorlds) -> Floats:
    """Return by how much rays start beside where they should [m], shape (3,)."""
    return BESIDE if run.compiled.model.nmesh else _NOWHERE


def meet_behind(
    run: RunningWorlds, rays: FrameRays, worlds: Worlds | None, own: Sequence[int]
) -> Hits:
    """Return the first hits of rays, except on some geoms of the world's body.

    MuJoCo passes through whole bodies only. Rays that meet one of these continue behind it.
    """
    start, passed = rays.start.copy(), np.zeros(rays.distance.shape)
    for _ in range(_MOST_PASSED):
        rays.start[:] = start + passed[..., None] * rays.along
        meet(run, rays, worlds)
        met = np.isin(rays.geom, own)
        if not met.any():
            break
        passed = np.where(met, passed + rays.distance + _BEHIND, passed)
    return Hits(passed + rays.distance, rays.inside)


def cast_from(
    run: RunningWorlds,
    link: str,
    place: Placement,
    rays: tuple[Floats, Floats],
    worlds: Worlds | None,
    *,
    ignore_own: bool,
) -> Hits:
    """Cast rays of a link to the nearest collision shape.

    Args:
        run: Worlds that run.
        link: Scoped name.
        place: Pose of the link.
        rays: Origins and directions in its frame, shapes (rays, 3).
        worlds: Worlds.
        ignore_own: Whether rays pass through the shapes of the link.
    """
    origins, directions = (np.ascontiguousarray(each, np.float64)[None] for each in rays)
    cast = FrameRays(origins, directions, len(place.position))
    at, turned = np.ascontiguousarray(place.position), np.ascontiguousarray(place.quaternion)
    cast.aim(at[:, None], turned[:, None], ray_offset(run))
    body = run.layout.link(link).body if ignore_own else 0
    if ignore_own and not body:
        inside = f"{link}::"
        own = [
            geom
            for name, geoms in run.layout.collisions.items()
            if name.startswith(inside)
            for geom in geoms
        ]
        return meet_behind(run, cast, worlds, own)
    meet(run, cast, worlds, body)
    return Hits(cast.distance, cast.inside)


class RaySpaces:
    """``mjData`` for threads that cast rays; see ``gazelle.engines.mujoco.ray_system.Workspaces``.

    Attributes:
        compiled: Model of the worlds.
    """

    def __init__(self, compiled: mujoco.MjModel, count: int) -> None:
        self.compiled = compiled
        self._model = compiled
        if compiled.opt.enableflags & _SLEEP:  # in what sleeps nothing would be computed
            self._model = copy(compiled)
            self._model.opt.enableflags &= ~_SLEEP
        self._data = [mujoco.MjData(self._model) for _ in range(count)]
        self.model = address_of_struct(self._model)
        self.table = np.array([self._addresses(each) for each in self._data], np.int64)
        self.kinematics, self.ray = address_of("mj_kinematics"), address_of("mj_ray")

    @staticmethod
    def _addresses(data: mujoco.MjData) -> list[int]:
        fields = data.qpos, data.mocap_pos, data.mocap_quat, data.xpos, data.xquat
        return [0, address_of_struct(data), *(each.ctypes.data for each in fields)]


class MujocoRanges:
    """Range finders with as many rays each; see ``gazelle.engines.range_rays.RangeTable``.

    Args:
        run: Worlds that run.
        rays: Rays of each range finder.
        spaces: For threads that cast them.
        update: Updates a system now.
    """

    begin = 0.0

    def __init__(
        self,
        run: RunningWorlds,
        rays: Sequence[RangeRays],
        spaces: RaySpaces,
        update: Callable[[System], None],
    ) -> None:
        slots = [run.layout.link(each.link) for each in rays]
        carried = FrameRays(*joined(rays), run.nworld)
        cast = RaySystem(
            carried,
            spaces,
            run.state,
            np.array([slot.body for slot in slots], np.int64),
            np.array([_wxyz(each.pose) for each in slots]),
            ray_offset(run),
            run.sheets,
            _GROUPS,
        )
        self.system: System | None = cast
        self.ranges: Floats = cast.ranges
        self._cast, self._update = cast, update

    def cast(self, worlds: Worlds | None = None) -> Floats:
        """Return distances now [m], shape (n, finders, rays); the next call may overwrite them."""
        rows = self._cast.rows
        whole = self.ranges.reshape(-1, rows, self.ranges.shape[1])
        if worlds is None:
            self._update(self._cast)
            return whole
        for world in world_indices(worlds, len(whole), EngineError).tolist():
            self._cast.update_from_python(world * rows, (world + 1) * rows, 0)
        return whole[worlds]


def _wxyz(pose: Pose) -> tuple[float, ...]:
    x, y, z, w = pose.quaternion
    return (*pose.position, w, x, y, z)


def joined(rays: Sequence[RangeRays]) -> tuple[Floats, Floats]:
    """Return origins and directions of the rays, each of shape (finders, rays, 3)."""
    return np.array([each.origins for each in rays]), np.array([each.directions for each in rays])
