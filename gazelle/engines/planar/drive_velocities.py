# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc"
"""Velocities of bodies by their drives."""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.engines.planar.drive_motion import twist_of
from cython.cimports.gazelle.native.system import System

from gazelle.array_types import Floats


@cython.cclass
class DriveVelocities(System):
    """Velocities that drives give their bodies, a row each: of cars not their commands.

    Args:
        bodies: Of all worlds.

    Attributes:
        velocities: In the bodies' own frames: x, y [m/s], yaw [rad/s], shape (nworld * nbody, 3).
    """

    def __init__(self, bodies: Bodies) -> None:
        System.__init__(self, max(1, bodies.nbody))
        self.bodies, self.velocities = bodies, np.zeros((bodies.nworld * bodies.nbody, 3))

    def update(self, first: int, last: int, time: int) -> None:  # noqa: ARG002  time plays no part
        """Compute some of them."""
        for b in range(first, min(last, self.velocities.shape[0])):
            note_velocity(self.bodies, b, self.velocities)


def note_velocity(w: Bodies, b: int, velocities: Floats) -> None:
    """Compute the velocity that the drive of a body gives it."""
    vx, vy, turn = twist_of(w, b, b % w.drives.shape[0])
    velocities[b, 0], velocities[b, 1], velocities[b, 2] = vx, vy, turn
