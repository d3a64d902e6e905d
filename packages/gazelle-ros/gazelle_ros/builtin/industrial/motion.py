"""Motion of joints along the points of a trajectory."""

from __future__ import annotations

import bisect
import math
from collections.abc import Sequence
from dataclasses import dataclass

from gazelle_ros.errors import RosError
from gazelle_ros.msgs import trajectory_msgs


@dataclass(frozen=True, slots=True)
class Waypoint:
    """Positions of joints at a time.

    Attributes:
        time: Since the start of the motion [s].
        positions: Of the joints [rad or m].
        velocities: Of the joints [rad/s or m/s]; empty where they are not given.
    """

    time: float
    positions: tuple[float, ...]
    velocities: tuple[float, ...] = ()


class WaypointMotion:
    """Positions along waypoints: cubic between two with velocities, else linear.

    Args:
        start: Positions of the joints, which are at rest [rad or m].
        points: Waypoints in the order of their times.
        interpolated: Whether there are positions between waypoints; else joints jump from one to the next.
    """

    def __init__(
        self, start: Sequence[float], points: Sequence[Waypoint], *, interpolated: bool = True
    ) -> None:
        rest = Waypoint(0.0, tuple(start), (0.0,) * len(start))
        self._points = [rest, *points]
        self._times = [each.time for each in self._points]
        self._interpolated = interpolated

    @property
    def duration(self) -> float:
        """Time of the last waypoint [s]."""
        return self._times[-1]

    def at(self, seconds: float) -> list[float]:
        """Return the positions at a time since the start [rad or m]."""
        passed = max(seconds, 0.0)
        index = bisect.bisect_right(self._times, passed)
        last = self._points[index - 1]
        if index == len(self._points) or not self._interpolated:
            return list(last.positions)
        return _between(last, self._points[index], passed)


def waypoints_of(
    message: trajectory_msgs.msg.JointTrajectory, joints: Sequence[str]
) -> list[Waypoint]:
    """Return the points of a trajectory for joints in an order of their own.

    Raises:
        RosError: It lacks a joint or positions, holds NaN, or goes back in time.
    """
    missing = [name for name in joints if name not in message.joint_names]
    if missing:
        raise RosError(f"the trajectory has no joint '{missing[0]}'")
    order = [message.joint_names.index(name) for name in joints]
    found: list[Waypoint] = []
    last = 0.0
    for number, point in enumerate(message.points):
        rows = [list(point.positions), list(point.velocities)]
        if len(rows[0]) != len(message.joint_names):
            raise RosError(f"point {number} of the trajectory has {len(rows[0])} positions")
        if len(rows[1]) not in (0, len(message.joint_names)):
            raise RosError(f"point {number} of the trajectory has {len(rows[1])} velocities")
        time = point.time_from_start.to_sec()
        if time < last or not all(map(math.isfinite, (*rows[0], *rows[1]))):
            raise RosError(f"point {number} of the trajectory is before the last one, or has NaN")
        last = time
        positions, velocities = (
            tuple(row[index] for index in order) if row else () for row in rows
        )
        found.append(Waypoint(time, positions, velocities))
    return found


def _between(first: Waypoint, second: Waypoint, seconds: float) -> list[float]:
    span = second.time - first.time
    share = (seconds - first.time) / span
    if not first.velocities or not second.velocities:
        pairs = zip(first.positions, second.positions, strict=True)
        return [here + share * (there - here) for here, there in pairs]
    square, cube = share**2, share**3
    end = 3.0 * square - 2.0 * cube
    begins, ends = span * (cube - 2.0 * square + share), span * (cube - square)
    rows = zip(first.positions, second.positions, first.velocities, second.velocities, strict=True)
    return [
        here + end * (there - here) + begins * before + ends * after
        for here, there, before, after in rows
    ]
