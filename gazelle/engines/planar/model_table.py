"""Many models at once: where they are, how they move, and what makes them move."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats, Indices
from gazelle.engines.motion import Motion, Placement
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.build import PlanarLayout
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.twist_commands import TwistCommands
from gazelle.errors import EngineError, did_you_mean
from gazelle.rotations import cross, from_yaw, multiply, rotate


class PlanarModelTable:
    """Some models of a layout, looked up once; what it gives is the same bits as one by one.

    Args:
        layout: Of the world.
        models: Their names.
        fleet: Moves them.
        rates: Of all joints, shape (nworld, axes).

    Raises:
        EngineError: There is no such model.
    """

    def __init__(
        self, layout: PlanarLayout, models: Sequence[str], fleet: Fleet, rates: Floats
    ) -> None:
        self._fleet, self._rates = fleet, rates
        unknown = [name for name in models if name not in layout.models]
        if unknown:
            raise EngineError(
                f"there is no model '{unknown[0]}'", hint=did_you_mean(unknown[0], layout.models)
            )
        found = [layout.models[name] for name in models]
        self._body: Indices = np.array([layout.bodies.get(name, -1) for name in models], np.intp)
        self._loose = np.array([each.loose for each in found])
        self._tilts = np.array([each.tilt.quaternion for each in found])
        self._first = np.array([layout.columns.get(name, 0) for name in models], np.intp)
        self._width = np.array([each.skeleton.width for each in found], np.intp)
        self._at = np.array([each.model.pose.position for each in found])
        self._turned = np.array([each.model.pose.quaternion for each in found])
        roots = [next(iter(each.skeleton.bones.values()), None) for each in found]
        self._arms = np.array([root.rest.position if root else (0.0,) * 3 for root in roots])
        # A first link that hangs on a joint moves otherwise than its model.
        self.rigid = all(root is None or root.fixed for root in roots)

    def command(self, law: TwistCommands) -> None:
        """Let a law with a row for each of the models give them their velocities."""
        bodies = np.where(self._loose, self._body, -1)
        law.carry(self._fleet.bodies, bodies, self._rates, self._first, self._width)

    def placement(self) -> Placement:
        """Of the models' frames: [m], shape (nworld, n, 3); (x, y, z, w), shape (nworld, n, 4)."""
        rows, which = self._rows(), np.flatnonzero(self._body >= 0)
        at = np.repeat(self._at[None], len(rows), axis=0)
        turned = np.repeat(self._turned[None], len(rows), axis=0)
        bodies = rows[:, self._body[which]]
        at[:, which] = bodies[..., [c.X, c.Y, c.Z]]
        turned[:, which] = multiply(from_yaw(bodies[..., c.YAW]), self._tilts[None, which])
        return Placement(at, turned)

    def motion(self, quaternion: Floats) -> Motion:
        """Of the models' first links, in the world frame [m/s, rad/s], shape (nworld, n, 3).

        Args:
            quaternion: Of ``placement``.
        """
        fleet, which = self._fleet, np.flatnonzero(self._loose)
        linear, spin = np.zeros((2, *quaternion.shape[:2], 3))
        shape = (fleet.nworld, fleet.nbody)
        own = self._body[which]
        v = fleet.velocity.reshape(*shape, 3)[:, own]
        v = np.where(fleet.stalled.reshape(shape)[:, own][..., None], 0.0, v)
        body = self._rows()[:, own]
        linear[:, which, 0] = body[..., c.COS] * v[..., 0] - body[..., c.SIN] * v[..., 1]
        linear[:, which, 1] = body[..., c.SIN] * v[..., 0] + body[..., c.COS] * v[..., 1]
        spin[:, which, 2] = v[..., 2]
        arm = rotate(quaternion, np.broadcast_to(self._arms, linear.shape))
        return Motion(linear + cross(spin, arm), spin)

    def _rows(self) -> Floats:
        fleet = self._fleet
        return fleet.rows.reshape(fleet.nworld, fleet.nbody, c.BODY)
