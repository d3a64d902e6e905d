"""Joints of many robots, read and driven at once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from gazelle.argument_checks import checked
from gazelle.array_types import Bools, Floats
from gazelle.errors import SimulationError
from gazelle.simulation.joints import JointHandle
from gazelle.simulation.state_lock import between_steps


@checked(SimulationError, after=True)
class JointArray:
    """First axes of some joints of one simulation, a column each; for plugins of many robots.

    Values are those of the joints' handles, to the bit, read and set in one call.

    Args:
        joints: At least one; none is a ball or floating joint.

    Raises:
        SimulationError: There is no joint.
    """

    def __init__(self, joints: Sequence[JointHandle]) -> None:
        if not joints:
            raise SimulationError("a group of joints needs at least one")
        self._simulation = joints[0].simulation
        self._shape = self._simulation.nworld, len(joints)
        self._rows = self._simulation.engine.joints[tuple(joint.name for joint in joints)]
        self._lock = self._simulation.lock

    @between_steps
    def positions(self) -> Floats:
        """Return positions [m or rad], shape (nworld, joints)."""
        return self._rows.position()

    @between_steps
    def velocities(self) -> Floats:
        """Return velocities [m/s or rad/s], shape (nworld, joints)."""
        return self._rows.velocity()

    @between_steps
    def place(self, position: ArrayLike, velocity: ArrayLike, chosen: Bools) -> None:
        """Set the positions of joints, clipped to their limits, and their velocities.

        Args:
            position: [m or rad], shape (nworld, joints) or one that broadcasts to it.
            velocity: [m/s or rad/s], likewise.
            chosen: Mask of joints, shape (joints,).
        """
        where, speed = (np.broadcast_to(each, self._shape) for each in (position, velocity))
        self._rows.place(where, speed, np.broadcast_to(chosen, self._shape))

    @between_steps
    def drive(self, velocity: ArrayLike, chosen: Bools | None = None) -> None:
        """Set what the joints' motors hold; ``JointHandle.add_motor`` gave them one.

        Args:
            velocity: [m/s or rad/s], shape (nworld, joints) or one that broadcasts to it.
            chosen: Mask of joints, shape (joints,); all if None.

        Raises:
            SimulationError: The velocities are of another shape, or not of numbers. NaN, as a
                policy may command it, ends its world in the next step.
        """
        try:
            velocities = np.broadcast_to(np.asarray(velocity, np.float64), self._shape)
        except (TypeError, ValueError, OverflowError) as error:
            raise SimulationError(
                f"the velocities of {self._shape[1]} motors cannot be {velocity!r}: {error}",
                hint=f"give a row of {self._shape[1]} for each of {self._shape[0]} worlds",
            ) from None
        self._rows.set_motor_velocity(velocities, chosen)
