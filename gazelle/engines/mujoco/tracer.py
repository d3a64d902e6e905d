"""Rays through visuals, followed by MuJoCo's native ray caster."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import mujoco
import numpy as np
from mujoco.batch import Batch

from gazelle.array_types import Floats
from gazelle.description import Link, Plane, Pose, Visual, World
from gazelle.engines.mujoco.compiler.shapes import ShapeBuilder
from gazelle.engines.mujoco.quaternions import wxyz_from_xyzw
from gazelle.engines.mujoco.rays import BESIDE
from gazelle.engines.tracer import RayHits
from gazelle.errors import EngineError


class MujocoTracer:
    """The visuals of a world as geoms that touch nothing; see ``engines.tracer.Tracer``.

    Links are kinematic bodies, so moving them costs nothing. Only links with a plane stand
    still, since MuJoCo's planes cannot move.

    Raises:
        EngineError: A shape cannot be built.
    """

    def __init__(self, world: World) -> None:
        self._spec = mujoco.MjSpec()
        self._shapes = ShapeBuilder(self._spec)
        self._visuals: list[Visual] = []
        self._owner: list[int] = []
        self._names: list[str] = []
        for model in world.models:
            for placed in model.walk():
                for link in placed.model.links:
                    self._add_link(f"{placed.scope}::{link.name}", link, placed.pose * link.pose)
        try:
            compiled = self._spec.compile()
        except ValueError as error:
            text = str(error).strip().splitlines()[0]
            raise EngineError(f"the visuals cannot be built: {text}") from error
        self._batch = Batch(compiled, 1)
        self._visual_of_geom = np.asarray(self._owner, dtype=np.intp)

    @property
    def visuals(self) -> tuple[Visual, ...]:
        """All visuals that can be met."""
        return tuple(self._visuals)

    def _add_link(self, name: str, link: Link, pose: Pose) -> None:
        if not link.visuals:
            return
        stands = any(isinstance(visual.geometry, Plane) for visual in link.visuals)
        x, y, z, w = pose.quaternion
        body = self._spec.worldbody.add_body(name=name, pos=list(pose.position), quat=[w, x, y, z])
        if not stands:
            body.mocap = True
            self._names.append(name)
        for visual in link.visuals:
            if visual.transparency >= 1.0:
                continue
            shapes = self._shapes.visible(visual.geometry, visual.pose, visual.source)
            for shape in shapes:
                body.add_geom(contype=0, conaffinity=0, mass=0.0, **_bounded(shape, visual))
                self._owner.append(len(self._visuals))
            self._visuals.append(visual)

    def place(self, poses: Mapping[str, Pose]) -> None:
        """Set the poses of links in the world, by scoped name."""
        model = self._batch.model
        for name in self._names:
            if name in poses:
                row = int(model.body_mocapid[model.body(name).id])
                self._batch.mocap_pos[0, row] = poses[name].position
                quaternion = np.asarray(poses[name].quaternion)
                self._batch.mocap_quat[0, row] = wxyz_from_xyzw(quaternion)

    def trace(self, origins: Floats, directions: Floats) -> RayHits:
        """Cast rays in the world frame, shapes (rays, 3), directions of unit length."""
        start = origins + BESIDE if self._batch.model.nmesh else origins
        distance, geom, normal = self._batch.ray(start, directions, normal=True)
        missed = geom[0] < 0
        if not self._owner:
            visual = np.full(len(origins), -1, dtype=np.intp)
        else:
            visual = np.where(missed, -1, self._visual_of_geom[np.maximum(geom[0], 0)])
        return RayHits(np.where(missed, np.inf, distance[0]), normal[0], visual)


def _bounded(shape: dict[str, Any], visual: Visual) -> dict[str, Any]:
    """Return a shape with its bounds: a visual plane has its size, a colliding one is infinite."""
    if isinstance(visual.geometry, Plane):
        x, y = visual.geometry.size
        return {**shape, "size": [x / 2, y / 2, 1.0]}
    return shape
