"""Rows of links in the arrays of planar worlds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Bools, Floats, Indices, Worlds
from gazelle.description import Pose
from gazelle.engines.hanging_links import HangingLinks
from gazelle.engines.motion import Hits, Motion, Placement
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.layout import PlanarLayout
from gazelle.engines.planar.ray_fans import Caster
from gazelle.engines.planar.tables.models import PlanarModelRow
from gazelle.engines.planar.unsupported import refuse
from gazelle.engines.planar.worlds import PlanarState, rows_of
from gazelle.engines.table import Lookup
from gazelle.rotations import conjugate, cross, multiply, rotate, unit


class PlanarLinkRow:
    """One link; see ``gazelle.engines.state.LinkRow``.

    Args:
        run: Worlds that run.
        name: Scoped name.
        model: Returns the row of a model.
        hanging: Moves links by the joints that they hang on.
        caster: Returns what casts rays of a link.
    """

    def __init__(
        self,
        run: PlanarState,
        name: str,
        model: Callable[[str], PlanarModelRow],
        hanging: HangingLinks,
        caster: Callable[[str, Floats, Floats], Caster],
    ) -> None:
        self._run, self._name, self._model, self._hanging = run, name, model, hanging
        self._caster = caster

    def placement(self, worlds: Worlds | None = None) -> Placement:
        """Return the pose of the link."""
        model = self._run.owner(self._name)
        base = self._model(model).placement(worlds)
        position, turned = self._run.model(model).tree.place(
            self._name, self._run.own(model, worlds)[0]
        )
        return Placement(
            base.position + rotate(base.quaternion, position), multiply(base.quaternion, turned)
        )

    def motion(self, worlds: Worlds | None = None) -> Motion:
        """Return the velocity of the link."""
        model = self._run.owner(self._name)
        base = self._model(model).placement(worlds)
        tree = self._run.model(model).tree
        angles, rates = self._run.own(model, worlds)
        inner = tree.motion(self._name, angles, rates)
        arm = rotate(base.quaternion, tree.place(self._name, angles)[0])
        linear, spin = self._model(model).twist(worlds)
        linear = linear + cross(spin, arm) + rotate(base.quaternion, inner[0])
        return Motion(linear, spin + rotate(base.quaternion, inner[1]))

    def acceleration(self, worlds: Worlds | None = None) -> Motion:
        """Return by how much the velocity changes: only towards the middle of the arc it is on."""
        motion = self.motion(worlds)
        spin = self._model(self._run.owner(self._name)).twist(worlds)[1]
        return Motion(cross(spin, motion.linear), np.zeros_like(spin))

    def centre(self, worlds: Worlds | None = None) -> Floats:
        """Return the centre of mass [m], in the world frame, shape (n, 3)."""
        place = self.placement(worlds)
        tree = self._run.model(self._run.owner(self._name)).tree
        inertial = tree.links[self._name].link.inertial
        offset = Pose() if inertial is None else inertial.pose
        return place.position + rotate(place.quaternion, np.asarray(offset.position)[None])

    def cast_rays(
        self,
        origins: Floats,
        directions: Floats,
        worlds: Worlds | None = None,
        *,
        ignore_own: bool = False,
    ) -> Hits:
        """Cast level rays to the nearest collision shape of another model."""
        del ignore_own  # rays never meet their own model
        return Hits(*self._caster(self._name, origins, directions).cast(worlds))

    def set_placement(
        self, position: ArrayLike, quaternion: ArrayLike, worlds: Worlds | None = None
    ) -> str:
        """Move the link's model, or its joint as far as that allows."""
        model = self._run.owner(self._name)
        tree = self._run.model(model).tree
        if tree.hinges:
            here = self.placement(worlds)
            goal = Placement(
                np.broadcast_to(np.asarray(position, np.float64), here.position.shape),
                unit(np.broadcast_to(np.asarray(quaternion, np.float64), here.quaternion.shape)),
            )
            if joint := self._hanging.place(self._name, goal, worlds):
                return joint
        at, turned = tree.place(self._name, self._run.own(model, worlds)[0])
        frame = multiply(np.asarray(quaternion, np.float64), conjugate(turned))
        origin = np.asarray(position, np.float64) - rotate(frame, at)
        self._model(model).set_placement(origin, frame, worlds)
        return ""

    def set_motion(
        self, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set the velocity of the link's model or joint so that the link moves as given."""
        model = self._run.owner(self._name)
        arm = self.placement(worlds).position - self._model(model).placement(worlds).position
        spin = np.broadcast_to(np.asarray(angular, np.float64), arm.shape)
        speed = np.broadcast_to(np.asarray(linear, np.float64), arm.shape)
        hinged = bool(self._run.model(model).tree.hinges)
        if hinged and self._hanging.move(self._name, Motion(speed, spin), worlds):
            return
        origin = np.asarray(linear, np.float64) - cross(spin, arm)
        self._model(model).set_motion(origin, spin, worlds)

    def set_wrench(self, force: ArrayLike, torque: ArrayLike, worlds: Worlds | None = None) -> None:
        """Raise an error: the plane has no forces."""
        del force, torque, worlds
        raise refuse(f"a push on '{self._name}'")


@dataclass(frozen=True, slots=True)
class _LinkColumns:
    """Some links in the fleet's tables.

    Attributes:
        moving: Links of models that are bodies, shape (k,).
        body: Bodies of those, shape (k,).
        free: Those of them of models that move by themselves, shape (k,).
        tilts: Quaternions by which their models' frames lean, shape (k, 4).
        base: Poses of the models' frames at first, shapes (links, 3) and (links, 4).
        rest: Poses in the models' frames with all joints at zero, likewise.
        hinged: Numbers, models and names of links that hang on a joint.
    """

    moving: Indices
    body: Indices
    free: Bools
    tilts: Floats
    base: Placement
    rest: Placement
    hinged: tuple[tuple[int, str, str], ...]

    @classmethod
    def find(cls, run: PlanarState, names: tuple[str, ...]) -> _LinkColumns:
        """Look up links.

        Raises:
            EngineError: There is no such link.
        """
        owners = [run.owner(name) for name in names]
        models = [run.model(owner) for owner in owners]
        links = [model.tree.links[name] for model, name in zip(models, names, strict=True)]
        body = np.array([run.layout.bodies.get(owner, -1) for owner in owners], np.intp)
        moving = np.flatnonzero(body >= 0)
        hinged = [i for i, link in enumerate(links) if not link.fixed]
        return cls(
            moving,
            body[moving],
            np.array([models[i].free for i in moving], np.bool_),
            np.array([models[i].tilt.quaternion for i in moving]).reshape(-1, 4),
            _stacked([model.model.pose for model in models]),
            _stacked([link.rest for link in links]),
            tuple((i, owners[i], names[i]) for i in hinged),
        )


class PlanarLinkRows:
    """Several links: all bodies are read at once, and one by one only links that hang on joints.

    See ``gazelle.engines.state.LinkRows``.

    Args:
        run: Worlds that run.
        names: Scoped names.
    """

    def __init__(self, run: PlanarState, names: tuple[str, ...]) -> None:
        self._run, self._names = run, names
        self._columns = Lookup[PlanarLayout, _LinkColumns](lambda _: _LinkColumns.find(run, names))

    def placement(self, worlds: Worlds | None = None) -> Placement:
        """Return the poses, shapes (n, links, 3) and (n, links, 4)."""
        base, inner = self._base(worlds), self._in_model(worlds)
        return Placement(
            base.position + rotate(base.quaternion, inner.position),
            multiply(base.quaternion, inner.quaternion),
        )

    def motion(self, worlds: Worlds | None = None) -> Motion:
        """Return the velocities, shape (n, links, 3)."""
        base, inner, twist = self._base(worlds), self._in_model(worlds), self._twist(worlds)
        linear = twist.linear + cross(twist.angular, rotate(base.quaternion, inner.position))
        for number, owner, name in self._columns.within(self._run.layout).hinged:
            tree, turn = self._run.model(owner).tree, base.quaternion[:, number]
            swing = tree.motion(name, *self._run.own(owner, worlds))
            linear[:, number] += rotate(turn, swing[0])
            twist.angular[:, number] += rotate(turn, swing[1])
        return Motion(linear, twist.angular)

    def acceleration(self, worlds: Worlds | None = None) -> Motion:
        """Return by how much the velocities change: only towards the middles of their arcs."""
        linear, spin = self.motion(worlds).linear, self._twist(worlds).angular
        return Motion(cross(spin, linear), np.zeros_like(spin))

    def _base(self, worlds: Worlds | None) -> Placement:
        """Return the poses of the models' frames, shapes (n, links, 3) and (n, links, 4)."""
        columns = self._columns.within(self._run.layout)
        poses = self._run.poses(columns.body, columns.tilts, worlds)
        at = np.repeat(columns.base.position[None], len(poses[0]), axis=0)
        turned = np.repeat(columns.base.quaternion[None], len(poses[0]), axis=0)
        at[:, columns.moving], turned[:, columns.moving] = poses
        return Placement(at, turned)

    def _twist(self, worlds: Worlds | None) -> Motion:
        """Return the velocities of the models' frames in the world, shape (n, links, 3)."""
        columns, fleet, rows = (
            self._columns.within(self._run.layout),
            self._run.fleet,
            rows_of(worlds),
        )
        shape = (fleet.nworld, fleet.nbody)
        v = fleet.velocity.reshape(*shape, 3)[rows][:, columns.body]
        resting = fleet.stalled.reshape(shape)[rows][:, columns.body] | ~columns.free
        v = np.where(resting[..., None], 0.0, v)
        body = fleet.body_rows[rows][:, columns.body]
        linear, spin = np.zeros((2, len(v), len(self._names), 3))
        linear[:, columns.moving, 0] = body[..., c.COS] * v[..., 0] - body[..., c.SIN] * v[..., 1]
        linear[:, columns.moving, 1] = body[..., c.SIN] * v[..., 0] + body[..., c.COS] * v[..., 1]
        spin[:, columns.moving, 2] = v[..., 2]
        return Motion(linear, spin)

    def _in_model(self, worlds: Worlds | None) -> Placement:
        """Return the poses in the models' frames."""
        columns, angles = self._columns.within(self._run.layout), self._run.angles[rows_of(worlds)]
        at = np.repeat(columns.rest.position[None], len(angles), axis=0)
        turned = np.repeat(columns.rest.quaternion[None], len(angles), axis=0)
        for number, owner, name in columns.hinged:
            own = self._run.own(owner, worlds)[0]
            at[:, number], turned[:, number] = self._run.model(owner).tree.place(name, own)
        return Placement(at, turned)


def _stacked(poses: Sequence[Pose]) -> Placement:
    """Return poses as arrays."""
    return Placement(
        np.array([pose.position for pose in poses]).reshape(-1, 3),
        np.array([pose.quaternion for pose in poses]).reshape(-1, 4),
    )
