"""Rows of models in the arrays of planar worlds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Bools, Floats, Indices, Worlds
from gazelle.description import Pose
from gazelle.engines.motion import Placement
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.body_conversion import ConvertedModel
from gazelle.engines.planar.body_poses import pose_of
from gazelle.engines.planar.body_writes import push, set_twists
from gazelle.engines.planar.layout import PlanarLayout
from gazelle.engines.planar.paths import PathFollower
from gazelle.engines.planar.twist_commands import TwistCommands
from gazelle.engines.planar.worlds import PlanarState, rows_of
from gazelle.engines.table import Lookup
from gazelle.errors import EngineError
from gazelle.native.paths import ModelPath
from gazelle.native.system import System
from gazelle.rotations import conjugate, multiply, yaw_of

_SAME = 1e-12  # how far components of quaternions may be apart to be taken as equal


class PlanarModelRow:
    """One model; see ``gazelle.engines.state.ModelRow``.

    Args:
        run: Worlds that run.
        name: Name of the model.
        make_kinematic: The engine's.
    """

    def __init__(self, run: PlanarState, name: str, make_kinematic: Callable[[str], None]) -> None:
        self._run, self._name, self._make_kinematic = run, name, make_kinematic
        self._place = Lookup[PlanarLayout, tuple[ConvertedModel, int | None]](
            lambda layout: (run.model(name), layout.bodies.get(name))
        )

    def placement(self, worlds: Worlds | None = None) -> Placement:
        """Return the pose of the model's frame."""
        each, body = self._place.within(self._run.layout)
        count = self._run.fleet.nworld if worlds is None else len(worlds)
        if body is None:
            pose = each.model.pose
            return Placement(
                np.tile(pose.position, (count, 1)), np.tile(pose.quaternion, (count, 1))
            )
        if count == 1:
            one = self.pose(0 if worlds is None else int(worlds[0]))
            return Placement(np.array((one.position,)), np.array((one.quaternion,)))
        lean = np.array((each.tilt.quaternion,))
        at, turned = self._run.poses(np.array((body,)), lean, worlds)
        return Placement(at[:, 0], turned[:, 0])

    def pose(self, world: int) -> Pose:
        """Return the pose of the model's frame in one world."""
        each, body = self._place.within(self._run.layout)
        if body is None:
            return each.model.pose
        fleet = self._run.fleet
        row = world * fleet.nbody + body
        return Pose.exactly(*pose_of(fleet.bodies, row, each.tilt.quaternion))

    def planar_pose(self, worlds: Worlds | None = None) -> Floats:
        """Return the pose seen from above: x, y [m] and heading [rad], shape (n, 3)."""
        each, body = self._place.within(self._run.layout)
        count = self._run.fleet.nworld if worlds is None else len(worlds)
        if body is None:
            pose = each.model.pose
            return np.tile((pose.x, pose.y, pose.yaw), (count, 1))
        found: Floats = self._run.fleet.rows[self._run.rows(body, worlds), : c.COS].copy()
        if each.leaning:
            found[:, c.YAW] = yaw_of(self.placement(worlds).quaternion)
        return found

    def path(self, path: ModelPath) -> System | None:
        """Return what moves the model along a path; None where that does not keep it upright."""
        flat = not path.spin[:2].any()
        if path.times.size:
            flat = np.ptp(path.quaternions, axis=0).max() < _SAME and not path.spin.any()
        if not flat:
            return None
        first = self._run.model(self._name).model.pose
        lean = (Pose(yaw=-first.yaw) * first).quaternion
        pose = path.quaternions[:1] if path.times.size else path.attitude[None]
        heading = float(yaw_of(multiply(pose, conjugate(np.asarray(lean)[None])))[0])
        bodies, body = self._run.fleet.bodies, self._run.layout.bodies[self._name]
        return PathFollower(path, bodies, body, heading)

    def set_placement(
        self, position: ArrayLike, quaternion: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set the pose of the model in the plane; a static model becomes kinematic.

        It keeps the way it leans; a robot on wheels stays on the ground.
        """
        each = self._run.model(self._name)
        if each.tree.held:
            raise EngineError(
                f"model '{self._name}' is fixed to the world by a joint and cannot be moved",
                hint="remove the joint that holds it",
            )
        if each.still:
            self._make_kinematic(self._name)
            each = self._run.model(self._name)
        place = np.atleast_2d(np.asarray(position, np.float64))
        turned = np.atleast_2d(np.asarray(quaternion, np.float64))
        if each.leaning:
            turned = multiply(turned, conjugate(np.asarray(each.tilt.quaternion)[None]))
        pose = np.empty((max(len(place), len(turned)), 3))
        pose[:, :2], pose[:, 2] = place[:, :2], yaw_of(turned)
        rolling = each.free and each.tree.wheels
        self._run.fleet.place(
            self._run.layout.bodies[self._name],
            pose,
            worlds,
            height=None if rolling else place[:, 2],
        )

    def set_motion(
        self, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set the velocity of the model, constant in its own frame, joints at rest."""
        each = self._run.model(self._name)
        if not each.free:
            return
        push(self._run.fleet.bodies, self._which(worlds), linear, angular)
        self._rest_joints(each, worlds)

    def set_ground_motion(self, twist: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set a lasting velocity of the model along and across its heading, joints at rest."""
        each = self._run.model(self._name)
        if not each.free:
            return
        set_twists(self._run.fleet.bodies, self._which(worlds), twist)
        self._rest_joints(each, worlds)

    def _which(self, worlds: Worlds | None) -> Indices:
        """Return its body in some worlds, all if None, counted through all worlds."""
        return self._run.fleet.which(self._run.layout.bodies[self._name], worlds)

    def _rest_joints(self, each: ConvertedModel, worlds: Worlds | None) -> None:
        first = self._run.layout.columns[self._name]
        self._run.rates[rows_of(worlds), first : first + each.tree.width] = 0.0

    def twist(self, worlds: Worlds | None) -> tuple[Floats, Floats]:
        """Return the velocity of the frame in the world: linear and angular, shapes (n, 3)."""
        count = self._run.fleet.nworld if worlds is None else len(worlds)
        linear, spin = np.zeros((count, 3)), np.zeros((count, 3))
        if not self._run.model(self._name).free:
            return linear, spin
        rows = self._run.rows(self._run.layout.bodies[self._name], worlds)
        body, v = self._run.fleet.rows[rows], self._run.fleet.velocity.reshape(-1, 3)[rows]
        v = np.where(self._run.fleet.stalled.reshape(-1)[rows][:, None], 0.0, v)
        linear[:, 0] = body[:, c.COS] * v[:, 0] - body[:, c.SIN] * v[:, 1]
        linear[:, 1] = body[:, c.SIN] * v[:, 0] + body[:, c.COS] * v[:, 1]
        spin[:, 2] = v[:, 2]
        return linear, spin


@dataclass(frozen=True, slots=True)
class _ModelColumns:
    """Some models in the fleet's tables.

    Attributes:
        body: Their bodies, shape (models,); -1 for a static model.
        free: Those that move by themselves, shape (models,).
        tilts: Quaternions by which their frames lean, shape (models, 4).
        first: First columns of their joints, shape (models,).
        width: Numbers of those columns, shape (models,).
        at: Positions of static models [m], shape (models, 3).
        turned: Their quaternions, shape (models, 4).
    """

    body: Indices
    free: Bools
    tilts: Floats
    first: Indices
    width: Indices
    at: Floats
    turned: Floats

    @classmethod
    def find(cls, run: PlanarState, names: tuple[str, ...]) -> _ModelColumns:
        """Look up models.

        Raises:
            EngineError: There is no such model.
        """
        found, layout = [run.model(name) for name in names], run.layout
        return cls(
            np.array([layout.bodies.get(name, -1) for name in names], np.intp),
            np.array([each.free for each in found], np.bool_),
            np.array([each.tilt.quaternion for each in found]).reshape(-1, 4),
            np.array([layout.columns.get(name, 0) for name in names], np.intp),
            np.array([each.tree.width for each in found], np.intp),
            np.array([each.model.pose.position for each in found]).reshape(-1, 3),
            np.array([each.model.pose.quaternion for each in found]).reshape(-1, 4),
        )


class PlanarModelRows:
    """Several models; see ``gazelle.engines.state.ModelRows``.

    Args:
        run: Worlds that run.
        names: Names of the models.
    """

    def __init__(self, run: PlanarState, names: tuple[str, ...]) -> None:
        self._run, self._names = run, names
        self._columns = Lookup[PlanarLayout, _ModelColumns](
            lambda _: _ModelColumns.find(run, names)
        )

    def placement(self, worlds: Worlds | None = None) -> Placement:
        """Return the poses of the models' frames, shapes (n, models, 3) and (n, models, 4)."""
        columns = self._columns.within(self._run.layout)
        which = np.flatnonzero(columns.body >= 0)
        poses = self._run.poses(columns.body[which], columns.tilts[which], worlds)
        at = np.repeat(columns.at[None], len(poses[0]), axis=0)
        turned = np.repeat(columns.turned[None], len(poses[0]), axis=0)
        at[:, which], turned[:, which] = poses
        return Placement(at, turned)

    def set_ground_motion(self, twist: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set lasting velocities of the models along and across their headings."""
        columns, fleet = self._columns.within(self._run.layout), self._run.fleet
        shape = (fleet.nworld if worlds is None else len(worlds), len(self._names), 3)
        given, which = np.broadcast_to(twist, shape), np.flatnonzero(columns.free)
        rows = np.arange(fleet.nworld) if worlds is None else worlds
        at = rows[:, None], columns.body[which]
        for values in (fleet.command, fleet.velocity):
            values.reshape(fleet.nworld, fleet.nbody, 3)[at] = given[:, which]
        fleet.stalled.reshape(fleet.nworld, fleet.nbody)[at] = False
        spans = [range(columns.first[i], columns.first[i] + columns.width[i]) for i in which]
        joints = np.array([column for span in spans for column in span], np.intp)
        self._run.rates[rows[:, None], joints] = 0.0

    def twist(self, linear: Floats, angular: Floats) -> System:
        """Return what gives the models their velocities."""
        columns, law = self._columns.within(self._run.layout), TwistCommands(linear, angular)
        bodies = np.where(columns.free, columns.body, -1)
        law.write(self._run.fleet.bodies, bodies, self._run.rates, columns.first, columns.width)
        return law
