"""Read and write where the models of a planar world are, and how they move."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.engines.motion import Placement
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.model_table import PlanarModelTable
from gazelle.engines.planar.running import RunningPlane, rows_of
from gazelle.errors import EngineError
from gazelle.rotations import conjugate, from_yaw, multiply, yaw_of

_MOST = 256  # sets of models that are known


class PlanarModels:
    """The part of ``gazelle.engines.engine.Engine`` that reads and moves models.

    Args:
        run: What runs.
        make_kinematic: The engine's.
    """

    def __init__(self, run: RunningPlane, make_kinematic: Callable[[str], None]) -> None:
        self._run, self._make_kinematic = run, make_kinematic
        self._tables: dict[tuple[str, ...], PlanarModelTable] = {}
        run.on_change.append(self._tables.clear)

    def model_placement(self, model: str, worlds: Worlds | None = None) -> Placement:
        """Where a model's frame is."""
        each = self._run.model(model)
        body = self._run.layout.bodies.get(model)
        if body is None:
            count = self._run.fleet.nworld if worlds is None else len(worlds)
            pose = each.model.pose
            return Placement(
                np.tile(pose.position, (count, 1)), np.tile(pose.quaternion, (count, 1))
            )
        rows = self._run.fleet.rows[self._run.rows(body, worlds)]
        turned = multiply(from_yaw(rows[:, c.YAW]), np.asarray(each.tilt.quaternion)[None])
        return Placement(rows[:, [c.X, c.Y, c.Z]], turned)

    def planar_pose(self, model: str, worlds: Worlds | None = None) -> Floats:
        """Where a model's frame is, seen from above: x, y [m] and heading [rad], shape (n, 3)."""
        each, body = self._run.model(model), self._run.layout.bodies.get(model)
        count = self._run.fleet.nworld if worlds is None else len(worlds)
        if body is None:
            pose = each.model.pose
            return np.tile((pose.x, pose.y, pose.yaw), (count, 1))
        found: Floats = self._run.fleet.rows[self._run.rows(body, worlds), : c.COS].copy()
        if each.leaning:
            found[:, c.YAW] = yaw_of(self.model_placement(model, worlds).quaternion)
        return found

    def set_model_placement(
        self, model: str, position: ArrayLike, quaternion: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Put a model somewhere in the plane; a static model becomes kinematic for it.

        It keeps the way it leans; a robot on wheels stays on the ground.
        """
        each = self._run.model(model)
        if each.skeleton.held:
            raise EngineError(
                f"model '{model}' is fixed to the world by a joint and cannot be moved",
                hint="the joint that holds it would have to go",
            )
        if each.still:
            self._make_kinematic(model)
            each = self._run.model(model)
        place = np.atleast_2d(np.asarray(position, np.float64))
        turned = np.atleast_2d(np.asarray(quaternion, np.float64))
        yaw = yaw_of(multiply(turned, conjugate(np.asarray(each.tilt.quaternion)[None])))
        count = max(len(place), len(yaw))
        pose = np.empty((count, 3))
        pose[:, :2], pose[:, 2] = place[:, :2], yaw
        body = self._run.layout.bodies[model]
        self._run.fleet.place(body, pose if count > 1 else pose[0], worlds)
        if not (each.loose and each.skeleton.wheels):
            self._run.fleet.rows[self._run.rows(body, worlds), c.Z] = place[:, 2]

    def set_model_motion(
        self, model: str, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give a model a velocity, which it keeps in its own frame, joints at rest."""
        each = self._run.model(model)
        if not each.loose:
            return
        rows = self._run.rows(self._run.layout.bodies[model], worlds)
        body = self._run.fleet.rows[rows]
        v, w = np.asarray(linear, np.float64), np.asarray(angular, np.float64)
        twist = np.empty((len(body), 3))
        twist[:, 0] = body[:, c.COS] * v[..., 0] + body[:, c.SIN] * v[..., 1]
        twist[:, 1] = body[:, c.COS] * v[..., 1] - body[:, c.SIN] * v[..., 0]
        twist[:, 2] = w[..., 2]
        self.set_ground_motion(model, twist, worlds)

    def set_ground_motion(self, model: str, twist: ArrayLike, worlds: Worlds | None = None) -> None:
        """Give a model a velocity along and across its heading, which it keeps, joints at rest."""
        each = self._run.model(model)
        if not each.loose:
            return
        rows = self._run.rows(self._run.layout.bodies[model], worlds)
        self._run.fleet.command.reshape(-1, 3)[rows] = twist
        self._run.fleet.velocity.reshape(-1, 3)[rows] = twist
        self._run.fleet.stalled.reshape(-1)[rows] = False
        first = self._run.layout.columns[model]
        self._run.rates[rows_of(worlds), first : first + each.skeleton.width] = 0.0

    def model_table(self, models: Sequence[str]) -> PlanarModelTable:
        """Models looked up once, to be read or moved together; good for one ``revision``."""
        key = tuple(models)
        table = self._tables.get(key)
        if table is None:
            if len(self._tables) >= _MOST:
                self._tables.clear()
            table = PlanarModelTable(self._run.layout, key, self._run.fleet, self._run.rates)
            self._tables[key] = table
        return table

    def twist(self, model: str, worlds: Worlds | None) -> tuple[Floats, Floats]:
        """Velocity of a model's frame in the world: linear and angular, shapes (n, 3)."""
        count = self._run.fleet.nworld if worlds is None else len(worlds)
        linear, spin = np.zeros((count, 3)), np.zeros((count, 3))
        if not self._run.model(model).loose:
            return linear, spin
        rows = self._run.rows(self._run.layout.bodies[model], worlds)
        body, v = self._run.fleet.rows[rows], self._run.fleet.velocity.reshape(-1, 3)[rows]
        v = np.where(self._run.fleet.stalled.reshape(-1)[rows][:, None], 0.0, v)
        linear[:, 0] = body[:, c.COS] * v[:, 0] - body[:, c.SIN] * v[:, 1]
        linear[:, 1] = body[:, c.SIN] * v[:, 0] + body[:, c.COS] * v[:, 1]
        spin[:, 2] = v[:, 2]
        return linear, spin
