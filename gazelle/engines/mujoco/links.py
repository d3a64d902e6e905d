"""Where links are, how they move, and what rays that they carry meet."""

from __future__ import annotations

import functools

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.description import Pose
from gazelle.engines.motion import Hits, Motion, Placement
from gazelle.engines.mujoco.order import xyzw_from_wxyz
from gazelle.engines.mujoco.rays import behind, nearest
from gazelle.engines.mujoco.rows import rows_of
from gazelle.engines.mujoco.running import RunningWorlds
from gazelle.engines.range_rays import RangeRays
from gazelle.rotations import cross, rotate, turns


@functools.lru_cache(maxsize=4096)
def still_placement(pose: Pose, count: int) -> Placement:
    """Where a link that never moves is, in so many worlds; read-only."""
    place = Placement(
        np.tile(np.array(pose.position), (count, 1)), np.tile(np.array(pose.quaternion), (count, 1))
    )
    place.position.flags.writeable = place.quaternion.flags.writeable = False
    return place


@functools.lru_cache(maxsize=64)
def still_motion(count: int) -> Motion:
    """How a link moves that does not, in so many worlds; read-only."""
    zeros = np.zeros((count, 3))
    zeros.flags.writeable = False
    return Motion(zeros, zeros)


class LinkAccess:
    """The part of ``gazelle.engines.engine.Engine`` that looks at links.

    Args:
        run: What runs.
    """

    def __init__(self, run: RunningWorlds) -> None:
        self._run = run

    def link_placement(self, link: str, worlds: Worlds | None = None) -> Placement:
        """Where a link is."""
        slot = self._run.known().link(link)
        rows = rows_of(worlds)
        if slot.free is not None:
            q = self._run.state.qpos[rows, slot.free.position]
            return Placement(q[:, :3].copy(), xyzw_from_wxyz(q[:, 3:]))
        if slot.mocap is not None:
            position = self._run.state.mocap_pos[rows, slot.mocap].copy()
            q = self._run.state.mocap_quat[rows, slot.mocap]
            return Placement(position, xyzw_from_wxyz(q))
        if slot.root == "static":
            return still_placement(slot.pose, self._run.nworld if worlds is None else len(worlds))
        self._run.refresh()
        position = self._run.batch.xpos[rows, slot.body].copy()
        return Placement(position, xyzw_from_wxyz(self._run.batch.xquat[rows, slot.body]))

    def link_motion(self, link: str, worlds: Worlds | None = None) -> Motion:
        """How a link moves."""
        slot = self._run.known().link(link)
        rows = rows_of(worlds)
        if slot.free is not None:
            v = self._run.state.qvel[rows, slot.free.velocity]
            q = self._run.state.qpos[rows, slot.free.position][:, 3:]
            return Motion(v[:, :3].copy(), rotate(xyzw_from_wxyz(q), v[:, 3:]))
        if slot.root is not None:
            return still_motion(self._run.nworld if worlds is None else len(worlds))
        self._run.refresh()
        # MuJoCo's cvel is about the centre of mass of the whole tree.
        spatial = self._run.batch.cvel[rows, slot.body]
        root = int(self._run.batch.model.body_rootid[slot.body])
        arm = self._run.batch.xpos[rows, slot.body] - self._run.batch.subtree_com[rows, root]
        angular = spatial[:, :3].copy()
        return Motion(spatial[:, 3:] + cross(angular, arm), angular)

    def cast_rays(
        self,
        link: str,
        origins: Floats,
        directions: Floats,
        worlds: Worlds | None = None,
        *,
        ignore_own: bool = False,
    ) -> Hits:
        """Follow rays to the nearest collision shape; see the protocol."""
        place = self.link_placement(link, worlds)
        turn = turns(place.quaternion)
        start, along = place.position[:, None, :] + origins @ turn, directions @ turn
        body = self._run.layout.link(link).body if ignore_own else 0
        if ignore_own and not body:
            inside = f"{link}::"
            own = [
                geom
                for name, geoms in self._run.layout.collisions.items()
                if name.startswith(inside)
                for geom in geoms
            ]
            return behind(self._run.batch, start, along, worlds, own)
        return nearest(self._run.batch, start, along, worlds, body)[0]

    def cast_ranges(self, rays: RangeRays, worlds: Worlds | None = None) -> tuple[Floats, float]:
        """Follow rays of a range finder; see the protocol."""
        hits = self.cast_rays(rays.link, rays.origins, rays.directions, worlds)
        return np.where(hits.from_inside, -np.inf, hits.distance), 0.0
