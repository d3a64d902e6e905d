"""Odometry from the encoders of two wheels, of one robot or of many at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.engines.limits import NANOSECONDS
from gazelle.plugins.odometry import OdometrySource
from gazelle.rotations import from_yaw
from gazelle.simulation import JointArray, JointHandle, Odometry
from gazelle.simulation.clock import Clock
from gazelle.simulation.values import NO_VARIANCE, SixNumbers


@dataclass(frozen=True, slots=True)
class ReckoningTables:
    """State of dead reckoning of some pairs of wheels, in all worlds; used in place.

    Attributes:
        pose: x, y [m] and heading [rad], shape (nworld, n, 3).
        twist: Forward velocity [m/s] and turning rate [rad/s], shape (nworld, n, 2).
        angles: Of the left and the right wheel when last looked at [rad], likewise.
        last_ns: Time of that [ns], shape (n,).
    """

    pose: Floats
    twist: Floats
    angles: Floats
    last_ns: NDArray[np.int64]

    @classmethod
    def empty(cls, nworld: int, count: int) -> ReckoningTables:
        """Return tables of ``count`` pairs, all zero."""
        twist, angles = np.zeros((2, nworld, count, 2))
        return cls(np.zeros((nworld, count, 3)), twist, angles, np.zeros(count, np.int64))

    def column(self, part: int) -> ReckoningTables:
        """Return a view of the same memory, of one pair."""
        own = slice(part, part + 1)
        return ReckoningTables(
            self.pose[:, own], self.twist[:, own], self.angles[:, own], self.last_ns[own]
        )

    def copy_from(self, other: ReckoningTables) -> None:
        """Copy what others of the same size have."""
        self.pose[:], self.twist[:] = other.pose, other.twist
        self.angles[:], self.last_ns[:] = other.angles, other.last_ns

    def interval(self, now_ns: int) -> Floats:
        """Return the time since the last wheel measurement [s], shape (n,)."""
        return np.asarray((now_ns - self.last_ns) / NANOSECONDS)

    def advance(
        self,
        angles: Floats,
        now_ns: int,
        separation: Floats,
        radius: Floats,
        rates: Floats | None = None,
    ) -> None:
        """Advance to other wheel angles, with the heading at the middle of the interval.

        Args:
            angles: Now [rad], shape (nworld, n, 2).
            now_ns: Simulated time [ns]; pairs for which none has passed stay.
            separation: Between the wheels of each pair [m], shape (n,).
            radius: Of the wheels of each pair [m], likewise.
            rates: Turning rates by another instrument [rad/s], shape (nworld, n); by the wheels if
                None.
        """
        interval = self.interval(now_ns)
        rolled = radius[:, None] * (angles - self.angles)
        self.angles[:], self.last_ns[:] = angles, now_ns
        some: slice | NDArray[np.intp] = slice(None)
        if not (interval > 0.0).all():
            some = np.flatnonzero(interval > 0.0)
            interval, rolled = interval[some], rolled[:, some]
        left, right = rolled[..., 0], rolled[..., 1]
        along = (left + right) / 2.0
        turned = (right - left) / separation[some] if rates is None else rates[:, some] * interval
        middle = self.pose[:, some, 2] + turned / 2.0
        self.pose[:, some, 0] += along * np.cos(middle)
        self.pose[:, some, 1] += along * np.sin(middle)
        self.pose[:, some, 2] += turned
        self.twist[:, some, 0], self.twist[:, some, 1] = along / interval, turned / interval


class DeadReckoning:
    """Adds up what a left and a right wheel roll, in every world.

    Args:
        clock: Gives the elapsed time.
        separation: Between the wheels [m].
        radius: Of the wheels [m].
        wheels: The left and the right.

    Attributes:
        clock: Clock of the samples.
        tables: Of one pair; a column of a group's.
    """

    def __init__(
        self, clock: Clock, separation: float, radius: float, wheels: Sequence[JointHandle]
    ) -> None:
        self.clock, self.wheels = clock, tuple(wheels)
        self.separation, self.radius = separation, radius
        angles = self._angles()
        self.tables = ReckoningTables.empty(len(angles), 1)
        self.tables.angles[:, 0] = angles
        self.restart()

    def join(self, tables: ReckoningTables) -> None:
        """Store the state in other tables of one pair from now on."""
        tables.copy_from(self.tables)
        self.tables = tables

    def restart(self) -> None:
        """Start the next interval now."""
        self.tables.last_ns[:] = self.clock.now_ns

    def reset(self, worlds: Worlds | None) -> None:
        """Reset the odometry to the origin, at the present wheel angles."""
        rows = slice(None) if worlds is None else worlds
        tables = self.tables
        tables.pose[rows], tables.twist[rows] = 0.0, 0.0
        tables.angles[rows, 0] = self._angles()[rows]

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state except the time."""
        tables = self.tables
        return {
            "pose": tables.pose[:, 0].copy(),
            "twist": tables.twist[:, 0].copy(),
            "angles": tables.angles[:, 0].copy(),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        tables = self.tables
        tables.pose[:, 0], tables.twist[:, 0] = state["pose"], state["twist"]
        tables.angles[:, 0] = state["angles"]

    @property
    def last_ns(self) -> int:
        """Time of the last advance [ns]."""
        return int(self.tables.last_ns[0])

    @last_ns.setter
    def last_ns(self, value: int) -> None:
        self.tables.last_ns[:] = value

    def _angles(self) -> Floats:
        return np.concatenate([wheel.positions()[:, :1] for wheel in self.wheels], axis=1)


class ReckoningGroup:
    """Dead reckoning for many robots of one simulation, with shared tables.

    Args:
        reckonings: Of each robot.

    Attributes:
        tables: Of all.
    """

    def __init__(self, reckonings: Sequence[DeadReckoning]) -> None:
        self._clock, nworld = reckonings[0].clock, len(reckonings[0].tables.pose)
        self.tables = ReckoningTables.empty(nworld, len(reckonings))
        for part, each in enumerate(reckonings):
            each.join(self.tables.column(part))
        self._separation = np.array([each.separation for each in reckonings])
        self._radius = np.array([each.radius for each in reckonings])
        self._joints = JointArray([wheel for each in reckonings for wheel in each.wheels])

    def interval(self) -> Floats:
        """Return the time since the last advance or restart [s], shape (n,)."""
        return self.tables.interval(self._clock.now_ns)

    def restart(self) -> None:
        """Start the next interval now."""
        self.tables.last_ns[:] = self._clock.now_ns

    def advance(self, rates: Floats | None = None) -> None:
        """Advance to now; see ``ReckoningTables.advance``."""
        angles = self._joints.positions().reshape(self.tables.angles.shape)
        self.tables.advance(angles, self._clock.now_ns, self._separation, self._radius, rates)


@dataclass(frozen=True, slots=True)
class RolledOdometry(OdometrySource):
    """Odometry from the rotation of wheels, by name.

    Args:
        reckoning: Of the wheels.
        frame: Of the pose.
        child_frame: Of the velocity.
        pose_variance: Of the six directions.
        signed: Whether going back is a negative velocity.
    """

    reckoning: DeadReckoning
    frame: str
    child_frame: str
    pose_variance: SixNumbers = NO_VARIANCE
    signed: bool = True

    def __call__(self) -> Odometry:
        """Return the odometry now."""
        return _measured([self])[0]

    @classmethod
    def measure_all(cls, sources: Sequence[RolledOdometry]) -> list[Odometry]:
        """Return the odometry of many robots."""
        return _measured(sources)


def _measured(sources: Sequence[RolledOdometry]) -> list[Odometry]:
    pose = np.concatenate([each.reckoning.tables.pose for each in sources], axis=1)
    twist = np.concatenate([each.reckoning.tables.twist for each in sources], axis=1)
    position, linear, angular = np.zeros((3, *pose.shape))
    position[..., :2], quaternion = pose[..., :2], from_yaw(pose[..., 2])
    linear[..., 0], angular[..., 2] = twist[..., 0], twist[..., 1]
    return [
        Odometry(
            each.reckoning.clock.now_ns,
            each.frame,
            each.child_frame,
            position[:, i],
            quaternion[:, i],
            linear[:, i] if each.signed else np.abs(linear[:, i]),
            angular[:, i],
            each.pose_variance,
        )
        for i, each in enumerate(sources)
    ]
