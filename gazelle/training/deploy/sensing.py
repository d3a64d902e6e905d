"""From readings of a robot's sensors to the observation of a contract."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Bools, Floats, Floats32
from gazelle.envs.contract import PolicyContract, ScanRule
from gazelle.errors import TaskError
from gazelle.navigation.angles import wrapped_all

_KINDS = {
    "goal_heading",
    "goal_distance",
    "nearest_range",
    "nearest_ray",
    "forward_speed",
    "yaw_rate",
}


@checked(TaskError, after=True)
@dataclass(frozen=True, slots=True)
class ScanReading:
    """One turn of a lidar, as sensor_msgs/LaserScan has it: the robot stands still by angles of NaN."""

    ranges: Floats
    """Ranges [m], shape (rays,); +inf nothing in range, -inf too near, NaN failed (REP 117)."""
    angle_min: float
    """Angle of the first ray, left positive [rad]."""
    angle_increment: float
    """Between two rays [rad]."""
    range_min: float = 0.0
    """The nearest the lidar can measure [m]."""
    range_max: float = math.inf
    """The farthest [m]."""

    def measured(self) -> Bools:
        """Return a mask of the rays with a measurable distance, shape (rays,)."""
        found: Bools = (self.ranges >= self.range_min) & (self.ranges <= self.range_max)
        return found & (self.ranges > 0.0)

    def failed(self) -> Bools:
        """Return a mask of the rays without a reading, shape (rays,): NaN, or 0 as in many drivers."""
        with np.errstate(invalid="ignore"):
            failed: Bools = np.isnan(self.ranges) | (self.ranges == 0.0)
        return failed

    def angles(self, turned: float = 0.0) -> Floats:
        """Return angles of the rays from straight ahead [rad], shape (rays,), in [-pi, pi].

        Args:
            turned: Yaw of the lidar itself, to the left [rad].
        """
        if not math.isfinite(turned):
            raise TaskError(f"the yaw of a lidar must be a finite number, not {turned!r:.60}")
        steps = np.arange(len(self.ranges), dtype=np.float64)
        angles: Floats = self.angle_min + turned + self.angle_increment * steps
        return wrapped_all(angles)


@dataclass(frozen=True, slots=True)
class OdometryReading:
    """Pose and velocity of a robot, as in nav_msgs/Odometry; by NaN the robot stands still."""

    x: float
    """X [m]"""
    y: float
    """Y [m]"""
    yaw: float
    """Yaw [rad], in [-pi, pi]"""
    forward: float = 0.0
    """Speed [m/s]."""
    turning: float = 0.0
    """Yaw rate, left positive [rad/s]."""


class Observer:
    """Makes the observations of a contract.

    Args:
        contract: Of the policy.
        turned: Yaw of the lidar on the robot, to the left [rad].

    Raises:
        TaskError: The contract has a part that no sensor gives.
    """

    def __init__(self, contract: PolicyContract, *, turned: float = 0.0) -> None:
        for part in contract.observation:
            known = part.kind in _KINDS or (part.kind == "scan" and contract.scan is not None)
            if not known:
                raise TaskError(
                    f"the policy sees '{part.name}', but its contract does not define how a "
                    "robot measures it",
                    hint="give the task a contract; docs/how-to/deploy.md says how",
                )
        self.contract = contract
        self.turned = turned

    def observe(
        self, scan: ScanReading, odometry: OdometryReading, goal: tuple[float, float]
    ) -> Floats32:
        """Return the observation of one moment.

        Args:
            scan: Of the lidar.
            odometry: In the frame of the goal.
            goal: x, y [m].

        Returns:
            Shape (1, entries), float32.
        """
        values: dict[str, Floats] = {
            "goal_heading": np.array([heading_to_goal(odometry, goal)]),
            "goal_distance": np.array([distance_to_goal(odometry, goal)]),
            "forward_speed": np.array([odometry.forward]),
            "yaw_rate": np.array([odometry.turning]),
        }
        rays = sum(part.size for part in self.contract.observation if part.kind == "scan")
        if self.contract.scan is not None and rays:
            ranges = sampled(scan, self.contract.scan, rays, turned=self.turned)
            ray = int(ranges.argmin())
            values["scan"] = ranges
            values["nearest_range"] = ranges[ray : ray + 1]
            values["nearest_ray"] = np.array([float(ray)])
        row: list[float] = []
        for part in self.contract.observation:
            numbers = values[part.kind].tolist()
            if part.decimals is not None:
                numbers = [round(number, part.decimals) for number in numbers]
            row += numbers
        return np.array([row], dtype=np.float32)


def sampled(scan: ScanReading, rule: ScanRule, rays: int, *, turned: float = 0.0) -> Floats:
    """Return the rays that a policy was trained with, from a scan with as many as it has.

    Each is the ray nearest in angle. Where that one failed, it is the nearest of those up to the
    middle between two rays of the policy that did not; where all of those failed, nothing is known
    there, and it counts as free as far as the lidar sees: a lidar that says 0 where nothing is in
    range is common. What stops the robot before obstacles, `SafetyLimits`, does not rest on this.

    Args:
        scan: Of the lidar.
        rule: Rule of the policy's ranges.
        rays: Number of its rays.
        turned: Yaw of the lidar, to the left [rad].

    Returns:
        Ranges [m] that a float32 holds exactly, shape (rays,).
    """
    angles = np.linspace(rule.first_angle, rule.last_angle, rays)
    away = np.abs(wrapped_all(scan.angles(turned)[None, :] - angles[:, None]))
    spacing = abs(rule.last_angle - rule.first_angle) / max(rays - 1, 1)
    usable = ~scan.failed()[None, :] & (away <= max(0.5 * spacing, 1e-6))
    ray = np.where(usable, away, np.inf).argmin(axis=1)
    nothing = ~usable.any(axis=1)
    raw = scan.ranges[ray].astype(np.float64)
    ranges = np.where(np.isposinf(raw) | nothing, rule.no_return, raw)
    ranges = np.where(np.isneginf(raw) & ~nothing, rule.too_near, ranges)
    ranges = np.where(np.isfinite(raw) & (raw > scan.range_max) & ~nothing, rule.no_return, ranges)
    return np.minimum(ranges, rule.farthest).astype(np.float32).astype(np.float64)


def distance_to_goal(odometry: OdometryReading, goal: tuple[float, float]) -> float:
    """Return the straight distance [m]."""
    return math.hypot(goal[0] - odometry.x, goal[1] - odometry.y)


def heading_to_goal(odometry: OdometryReading, goal: tuple[float, float]) -> float:
    """Return the angle from straight ahead to the goal, left positive [rad], in [-pi, pi]."""
    angle = math.atan2(goal[1] - odometry.y, goal[0] - odometry.x) - odometry.yaw
    return float(wrapped_all(np.array(angle)))
