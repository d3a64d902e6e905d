"""Motion state of Stage's robots: their odometry, and their poses before a step."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.engines.planar import DriveVelocities, Fleet
from gazelle.native.system import System
from gazelle.stage.odometry import WheelOdometry
from gazelle.stage.reckoning import PoseMemory, StallMemory
from gazelle.stage.robots import StageRobot
from gazelle.stage.steering import Steering


class DriveState:
    """State that is updated with every step of some robots, in native code.

    Args:
        robots: The first of the fleet's bodies.
        fleet: Fleet that moves them.
        seed: The run's seed.

    Attributes:
        odometry: Their odometry.
        steering: Steering of the cars.
        first: Systems to be updated at the beginning of a step.
        last: At the end.
    """

    def __init__(self, robots: Sequence[StageRobot], fleet: Fleet, seed: int) -> None:
        self._fleet, self._count = fleet, len(robots)
        self.odometry = WheelOdometry(robots, fleet.nworld, seed, euler=fleet.euler)
        self.steering = Steering(robots)
        self._memory = PoseMemory(fleet.pose.reshape(-1, 3), fleet.nworld)
        self._poses = np.asarray(self._memory.poses).reshape(fleet.nworld, fleet.nbody, 3)
        self.first: list[System] = [self._memory]
        self.last: list[System] = []
        if self.odometry.needed:
            driven = fleet.velocity
            if self.steering.needed:
                drives = DriveVelocities(fleet.bodies)
                driven = np.asarray(drives.velocities).reshape(driven.shape)
                self.last.append(drives)
            self.last.append(self.odometry.system(driven, fleet.time_step))
        self._stalls: StallMemory | None = None
        self.remember()

    def watch(self) -> NDArray[np.bool_]:
        """Return whether robots were stalled since this was last cleared, shape (nworld, nrobot)."""
        fleet = self._fleet
        if self._stalls is None:
            now = fleet.stalled.view(np.uint8).reshape(-1)
            self._stalls = StallMemory(now, fleet.nworld)
            self.last = [*self.last, self._stalls]
        stalled = np.asarray(self._stalls.stalled).view(np.bool_)
        return stalled.reshape(fleet.nworld, fleet.nbody)[:, : self._count]

    @property
    def before(self) -> Floats:
        """x, y [m] and heading [rad] before the last step, shape (nworld, nrobot, 3)."""
        return self._poses[:, : self._count]

    def remember(self, worlds: Worlds | None = None) -> None:
        """Store the present poses as the previous ones."""
        rows = slice(None) if worlds is None else worlds
        self._poses[rows] = self._fleet.pose[rows]

    def reset(self, worlds: Worlds | None = None) -> None:
        """Start over."""
        self.odometry.reset(worlds)
        self.remember(worlds)

    def copy_from(self, other: DriveState, pairs: Iterable[tuple[int, int]]) -> None:
        """Copy the state of another.

        Robots that both have are given by their indices there and here.
        """
        for there, here in pairs:
            self._poses[:, here] = other._poses[:, there]  # its own class
            if self.odometry.needed and other.odometry.needed:
                self.odometry.pose[:, here] = other.odometry.pose[:, there]
                self.odometry.share[:, here] = other.odometry.share[:, there]

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state, for a snapshot."""
        return {
            "before": self._poses.copy(),
            "odometry": self.odometry.pose.copy(),
            "share": self.odometry.share.copy(),
            "drawn": self.odometry.stream.counters.copy(),
        }

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._poses[:] = state["before"]
        self.odometry.pose[:] = state["odometry"]
        self.odometry.share[:] = state["share"]
        self.odometry.stream.counters[:] = state["drawn"]
