# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="misc"
"""Bases that slide by commands: level velocities of free bodies along their headings."""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.native.system import System
from cython.cimports.libc.math import sqrt

from gazelle.array_types import Floats, Indices


@cython.cclass
class LevelMotion(System):
    """Some models in all worlds, each moved by one free body, with their commanded velocities.

    Args:
        linear: Forward and to the left [m/s], shape (nworld, n, 3); the third does nothing.
        angular: The third is the turning rate [rad/s], likewise.
        qpos: Positions of all joints, shape (nworld, positions).
        qvel: Their velocities, shape (nworld, velocities); written.
        places: First position and first velocity of each body, shape (n, 2).
        frames: Pose of each model in its body: [m], (x, y, z, w), shape (n, 7).
        owners: Of each other velocity of the models the model, shape (velocities,), increasing.
        dofs: Its column, likewise; they are at rest.
        changed: Set to 1 at every update, shape (1,).
    """

    def __init__(
        self,
        linear: Floats,
        angular: Floats,
        qpos: Floats,
        qvel: Floats,
        places: Indices,
        frames: Floats,
        owners: Indices,
        dofs: Indices,
        changed: Floats,
    ) -> None:
        System.__init__(self, linear.shape[1])
        self.linear, self.angular, self.qpos, self.qvel = linear, angular, qpos, qvel
        self.uses = qpos, qvel
        self.places, self.frames, self.dofs, self.changed = places, frames, dofs, changed
        self.start = np.searchsorted(owners, np.arange(linear.shape[1] + 1)).astype(np.intp)

    def update(self, first: int, last: int, time: int) -> None:  # noqa: ARG002
        """Set the velocities of bodies."""
        self.changed[0] = 1.0
        for row in range(first, last):
            self.move(row // self.rows, row % self.rows)

    def move(self, world: int, i: int) -> None:
        """Set the velocity of a body of a world."""
        place, dof = self.places[i, 0] + 3, self.places[i, 1]
        w, x = self.qpos[world, place], self.qpos[world, place + 1]
        y, z = self.qpos[world, place + 2], self.qpos[world, place + 3]
        # The model's frame in the world.
        a, b, c = self.frames[i, 3], self.frames[i, 4], self.frames[i, 5]
        d = self.frames[i, 6]
        p, q = w * a + d * x + (y * c - z * b), w * b + d * y + (z * a - x * c)
        r, s = w * c + d * z + (x * b - y * a), w * d - (x * a + y * b + z * c)
        sine, cosine = 2.0 * (s * r + p * q), 1.0 - 2.0 * (q * q + r * r)
        length = sqrt(sine * sine + cosine * cosine)
        if length > 0.0:
            sine, cosine = sine / length, cosine / length
        else:
            sine, cosine = 0.0, 1.0
        # From the model's origin to the body's.
        a, b, c = self.frames[i, 0], self.frames[i, 1], self.frames[i, 2]
        u, v, t = 2.0 * (y * c - z * b), 2.0 * (z * a - x * c), 2.0 * (x * b - y * a)
        ax, ay = -(a + w * u + (y * t - z * v)), -(b + w * v + (z * u - x * t))
        ahead, across = self.linear[world, i, 0], self.linear[world, i, 1]
        rate = self.angular[world, i, 2]
        self.qvel[world, dof] = cosine * ahead - sine * across - rate * ay
        self.qvel[world, dof + 1] = sine * ahead + cosine * across + rate * ax
        self.qvel[world, dof + 2] = 0.0
        self.qvel[world, dof + 3] = 2.0 * (x * z - w * y) * rate
        self.qvel[world, dof + 4] = 2.0 * (y * z + w * x) * rate
        self.qvel[world, dof + 5] = (1.0 - 2.0 * (x * x + y * y)) * rate
        for k in range(self.start[i], self.start[i + 1]):
            self.qvel[world, self.dofs[k]] = 0.0
