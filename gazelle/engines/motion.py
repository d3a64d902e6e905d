"""Poses, velocities and ray hits in each world; see ``engine`` for frames."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.description import Pose
from gazelle.errors import EngineError
from gazelle.rotations import conjugate, multiply, rotate


@dataclass(frozen=True, slots=True)
class Placement:
    """Pose in each world.

    Attributes:
        position: [m], shape (n, 3).
        quaternion: Unit quaternions (x, y, z, w), shape (n, 4).
    """

    position: Floats
    quaternion: Floats

    def first(self) -> Pose:
        """Return the pose in the first world."""
        return Pose.from_quaternion(self.position[0].tolist(), self.quaternion[0].tolist())

    @checked(EngineError, after=True)
    def relative_to(self, frame: Placement) -> Placement:
        """Return the placement in a frame that is itself placed in the same frame."""
        back = conjugate(frame.quaternion)
        return Placement(
            rotate(back, self.position - frame.position), multiply(back, self.quaternion)
        )


@dataclass(frozen=True, slots=True)
class Motion:
    """Velocity in each world, in the world frame.

    Attributes:
        linear: Velocity of its origin [m/s], shape (n, 3).
        angular: Angular velocity [rad/s], shape (n, 3).
    """

    linear: Floats
    angular: Floats


@dataclass(frozen=True, slots=True)
class Hits:
    """Hits of rays in each world.

    Attributes:
        distance: To the nearest collision shape [m], shape (n, rays); infinite for none.
        from_inside: Whether the ray started inside that shape, shape (n, rays).
    """

    distance: Floats
    from_inside: NDArray[np.bool_]
