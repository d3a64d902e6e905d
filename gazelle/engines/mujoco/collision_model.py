"""Collision models by MuJoCo's collision functions alone, without time or forces."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import mujoco

from gazelle.array_types import Floats
from gazelle.description import Pose
from gazelle.engines.collision import BodyContact, CollisionBody
from gazelle.engines.mujoco.compiler.shapes import ShapeBuilder
from gazelle.engines.mujoco.library import disable_logging
from gazelle.formats import MeshData

_OWN = "/"
"""Before the names of bodies, as MuJoCo has a body named world itself."""

_HINGE, _SLIDE = mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE


class MujocoCollisionModel:
    """A robot and the obstacles around it; see ``gazelle.engines.collision_model``."""

    def __init__(
        self,
        bodies: Sequence[CollisionBody],
        obstacles: Sequence[CollisionBody],
        ignored: Iterable[tuple[str, str]],
        padding: Mapping[str, float],
    ) -> None:
        disable_logging()
        spec = mujoco.MjSpec()
        spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_FILTERPARENT)
        self._builder = ShapeBuilder(spec)
        self._padding = dict(padding)
        names = {body.name for body in (*bodies, *obstacles)}
        widest = sorted((self._padding.get(name, 0.0) for name in names), reverse=True)[:2]
        self._margin = max(0.0, sum(widest))
        self._build(spec, bodies, obstacles)
        for first, second in ignored:
            if first in names and second in names:
                spec.add_exclude(bodyname1=_OWN + first, bodyname2=_OWN + second)
        self._model = spec.compile()
        self._data = mujoco.MjData(self._model)
        self._names = [
            self._model.body(index).name.removeprefix(_OWN) for index in range(self._model.nbody)
        ]
        self._still = {body.name for body in obstacles}

    def _build(
        self,
        spec: mujoco.MjSpec,
        bodies: Sequence[CollisionBody],
        obstacles: Sequence[CollisionBody],
    ) -> None:
        weight = {"mass": 1.0, "inertia": [1.0, 1.0, 1.0], "explicitinertial": True}
        root = spec.worldbody.add_body(name=" base", **weight)
        root.add_freejoint()
        made = {"": root}
        for body in bodies:
            handle = made[body.parent].add_body(
                name=_OWN + body.name, **weight, **_place(body.pose)
            )
            if body.axis is not None:
                kind = _SLIDE if body.slides else _HINGE
                handle.add_joint(type=kind, axis=list(body.axis))
            made[body.name] = handle
            self._add_shapes(handle, body, static=False)
        for body in obstacles:
            handle = spec.worldbody.add_body(name=_OWN + body.name, **_place(body.pose))
            self._add_shapes(handle, body, static=True)

    def _add_shapes(self, handle: mujoco.MjsBody, body: CollisionBody, *, static: bool) -> None:
        for shape, pose in body.shapes:
            if isinstance(shape, MeshData):
                geoms = self._builder.data_options(shape, pose, static=static)
            else:
                geoms = self._builder.options(shape, pose, None, static=static)
            for geom in geoms:
                handle.add_geom(margin=self._margin, **geom)

    def place(self, positions: Floats, base: Sequence[float] | None = None) -> None:
        """Move the robot; see ``CollisionModel.place``."""
        data = self._data
        data.qpos[7:] = positions
        if base is not None:
            data.qpos[:3] = base[:3]
            data.qpos[3:7] = base[6], *base[3:6]
        mujoco.mj_kinematics(self._model, data)
        mujoco.mj_collision(self._model, data)

    def touches(self, positions: Floats) -> bool:
        """Return whether anything touches with the joints at some positions, shape (joints,)."""
        data = self._data
        data.qpos[7:] = positions
        mujoco.mj_kinematics(self._model, data)
        mujoco.mj_collision(self._model, data)
        if data.ncon == 0:
            return False
        if self._margin == 0.0:
            return bool((data.contact.dist[: data.ncon] < 0.0).any())
        return bool(self.contacts())

    def contacts(self) -> list[BodyContact]:
        """Return the contacts of the last placement: of each pair the deepest."""
        found: dict[tuple[str, str], BodyContact] = {}
        owners = self._model.geom_bodyid
        for number in range(self._data.ncon):
            contact = self._data.contact[number]
            first, second = (self._names[owners[geom]] for geom in contact.geom)
            depth = self._allowance(first, second) - contact.dist
            known = found.get((first, second))
            if depth > 0.0 and (known is None or depth > known.depth):
                point, normal = contact.pos.tolist(), contact.frame[:3].tolist()
                found[first, second] = BodyContact(
                    first, second, float(depth), tuple(point), tuple(normal)
                )
        return list(found.values())

    def _allowance(self, first: str, second: str) -> float:
        """Return the distance at which two bodies touch; a robot's own parts have no padding."""
        if not {first, second} & self._still:
            return 0.0
        return self._padding.get(first, 0.0) + self._padding.get(second, 0.0)


def _place(pose: Pose) -> dict[str, list[float]]:
    x, y, z, w = pose.quaternion
    return {"pos": list(pose.position), "quat": [w, x, y, z]}
