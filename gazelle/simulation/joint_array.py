"""Joints of many robots, read and driven at once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Bools, Floats
from gazelle.errors import SimulationError
from gazelle.simulation.joints import JointHandle
from gazelle.simulation.requests import between_steps


class JointArray:
    """First axes of some joints of one simulation, a column each; for plugins of many robots.

    It gives what each joint's handle would, to the bit, in one call where the engine can.

    Args:
        joints: At least one; none is a ball or floating joint.

    Raises:
        SimulationError: There is no joint.
    """

    def __init__(self, joints: Sequence[JointHandle]) -> None:
        if not joints:
            raise SimulationError("a group of joints needs at least one")
        self._joints = tuple(joints)
        self._names = tuple(joint.name for joint in joints)
        self._simulation = joints[0].simulation
        self._requests = self._simulation.requests

    @between_steps
    def positions(self) -> Floats:
        """[m or rad], shape (nworld, joints)."""
        engine = self._simulation.tables
        if engine is not None:
            return engine.joint_positions(self._names)
        return np.concatenate([joint.positions()[:, :1] for joint in self._joints], axis=1)

    @between_steps
    def velocities(self) -> Floats:
        """[m/s or rad/s], shape (nworld, joints)."""
        engine = self._simulation.tables
        if engine is not None:
            return engine.joint_velocities(self._names)
        return np.concatenate([joint.velocities()[:, :1] for joint in self._joints], axis=1)

    @between_steps
    def place(self, position: ArrayLike, velocity: ArrayLike, chosen: Bools) -> None:
        """Put joints somewhere, to their limits at most, and give them velocities.

        Args:
            position: [m or rad], shape (nworld, joints) or one that broadcasts to it.
            velocity: [m/s or rad/s], likewise.
            chosen: Which joints, shape (joints,).
        """
        shape = (self._simulation.nworld, len(self._joints))
        where, speed = np.broadcast_to(position, shape), np.broadcast_to(velocity, shape)
        engine = self._simulation.tables
        if engine is not None:
            engine.place_joints(self._names, where, speed, np.broadcast_to(chosen, shape))
            return
        for column in np.flatnonzero(chosen):
            joint = self._joints[column]
            joint.position, joint.velocity = where[:, column], speed[:, column]

    @between_steps
    def drive(self, velocity: ArrayLike, chosen: Bools | None = None) -> None:
        """Set what the joints' motors hold; ``JointHandle.add_motor`` gave them one.

        Args:
            velocity: [m/s or rad/s], shape (nworld, joints) or one that broadcasts to it.
            chosen: Which joints, shape (joints,); all if None.

        Raises:
            SimulationError: The velocities are of another shape, or one is no number.
        """
        shape = (self._simulation.nworld, len(self._joints))
        try:
            wanted = np.asarray(velocity, np.float64)
            if wanted.shape != shape:
                wanted = np.broadcast_to(wanted, shape)
        except (TypeError, ValueError) as error:
            raise SimulationError(
                f"the velocities of {shape[1]} motors cannot be {velocity!r}: {error}",
                hint=f"give a row of {shape[1]} for each of {shape[0]} worlds",
            ) from None
        engine = self._simulation.tables
        if engine is not None:
            engine.drive_joints(self._names, wanted, chosen)
            return
        for column, joint in enumerate(self._joints):
            if chosen is None or chosen[column]:
                joint.drive(wanted[:, column])
