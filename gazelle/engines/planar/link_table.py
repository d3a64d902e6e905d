"""Where many links are at once: all bodies in one go, and by itself only what hangs on a joint."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats, Indices, Worlds
from gazelle.engines.motion import Placement
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.build import PlanarLayout
from gazelle.engines.planar.fleet import Fleet
from gazelle.errors import EngineError, did_you_mean
from gazelle.rotations import from_yaw, multiply, rotate


class PlanarLinkTable:
    """Some links of a layout, looked up once.

    Args:
        layout: Of the world.
        links: Their scoped names.

    Attributes:
        layout: As given; another one has other links.

    Raises:
        EngineError: There is no such link.
    """

    def __init__(self, layout: PlanarLayout, links: Sequence[str]) -> None:
        self.layout = layout
        self._body = np.full(len(links), -1, np.intp)
        self._at, self._turned = np.zeros((len(links), 3)), np.zeros((len(links), 4))
        self._tilts = np.zeros((len(links), 4))
        self._tilts[:, 3] = 1.0
        self._hinged: list[tuple[int, str, str]] = []
        for number, link in enumerate(links):
            self._enter(number, link)
        self._moving: Indices = np.flatnonzero(self._body >= 0)

    def _enter(self, number: int, link: str) -> None:
        layout = self.layout
        owner = layout.owners.get(link)
        if owner is None:
            raise EngineError(f"there is no link '{link}'", hint=did_you_mean(link, layout.owners))
        anatomy = layout.models[owner]
        bone = anatomy.skeleton.bones[link]
        body = layout.bodies.get(owner)
        pose = bone.rest
        if body is None:
            pose = anatomy.model.pose * bone.rest
        else:
            self._body[number], self._tilts[number] = body, anatomy.tilt.quaternion
        self._at[number], self._turned[number] = pose.position, pose.quaternion
        if not bone.fixed:
            self._hinged.append((number, owner, link))

    def placement(self, fleet: Fleet, angles: Floats, worlds: Worlds | None) -> Placement:
        """Positions [m], shape (n, links, 3), and quaternions (x, y, z, w), shape (n, links, 4).

        Args:
            fleet: Knows where the bodies are.
            angles: Of all joints, shape (nworld, axes).
            worlds: Which worlds; all if None.
        """
        chosen = slice(None) if worlds is None else worlds
        rows = fleet.rows.reshape(fleet.nworld, fleet.nbody, c.BODY)[chosen]
        count = len(rows)
        at = np.repeat(self._at[None], count, axis=0)
        turned = np.repeat(self._turned[None], count, axis=0)
        self._turn_hinges(at, turned, angles[chosen])
        which = self._moving
        bodies = rows[:, self._body[which]]
        base = multiply(from_yaw(bodies[..., c.YAW]), self._tilts[None, which])
        at[:, which] = bodies[..., [c.X, c.Y, c.Z]] + rotate(base, at[:, which])
        turned[:, which] = multiply(base, turned[:, which])
        return Placement(at, turned)

    def _turn_hinges(self, at: Floats, turned: Floats, angles: Floats) -> None:
        """Place what hangs on a joint in its model's frame."""
        layout = self.layout
        for number, owner, link in self._hinged:
            anatomy, first = layout.models[owner], layout.columns[owner]
            own = angles[:, first : first + anatomy.skeleton.width]
            at[:, number], turned[:, number] = anatomy.skeleton.place(link, own)
            if self._body[number] < 0:
                pose = anatomy.model.pose
                base = np.asarray(pose.quaternion)[None]
                at[:, number] = np.asarray(pose.position) + rotate(base, at[:, number])
                turned[:, number] = multiply(base, turned[:, number])
