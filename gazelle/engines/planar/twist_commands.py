# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc"
"""Bodies that move at once by commands: forward, sideways and turning."""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.native.system import System
from numpy.typing import NDArray

from gazelle.array_types import Floats


@cython.cclass
class TwistCommands(System):
    """Some bodies in all worlds, a row each, with the velocities of their commands.

    Args:
        linear: Forward and to the left [m/s], shape (nworld, n, 3); the third does nothing.
        angular: The third is the turning rate [rad/s], likewise.
    """

    def __init__(self, linear: Floats, angular: Floats) -> None:
        System.__init__(self, linear.shape[1])
        self.least = 1000
        self.linear, self.angular = linear, angular
        self.body = np.full(self.rows, -1, np.intp)

    def write(
        self,
        bodies: Bodies,
        body: NDArray[np.intp],
        rates: Floats,
        first: NDArray[np.intp],
        width: NDArray[np.intp],
    ) -> None:
        """Set the bodies that twists move.

        Args:
            bodies: Of all models.
            body: Indices of the bodies, shape (n,); -1 for one that does not move by itself.
            rates: Of all joints, shape (nworld, axes); those of what moves are at rest.
            first: Column of its first joint, shape (n,).
            width: Number of them, shape (n,).
        """
        self.bodies, self.rates = bodies, rates
        self.body, self.first_joint, self.width = body, first, width

    def update(self, first: int, last: int, time: int) -> None:  # noqa: ARG002
        """Set the velocities of bodies."""
        for row in range(first, last):
            w, i = row // self.rows, row % self.rows
            if self.body[i] < 0:
                continue
            b = w * self.bodies.nbody + self.body[i]
            for axis in range(3):
                wanted = self.angular[w, i, 2] if axis == 2 else self.linear[w, i, axis]
                self.bodies.command[b, axis] = wanted
                self.bodies.velocity[b, axis] = wanted
            self.bodies.stalled[b] = 0
            for joint in range(self.first_joint[i], self.first_joint[i] + self.width[i]):
                self.rates[w, joint] = 0.0
