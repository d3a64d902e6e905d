"""Safety limits of a deployed policy; they override its commands."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np

from gazelle.argument_checks import checked
from gazelle.envs.contract import PolicyContract
from gazelle.errors import TaskError
from gazelle.training.deploy.sensing import OdometryReading, ScanReading

_MARGIN = 0.03  # [m] that are driven between two scans of 5 Hz at 0.15 m/s
_STOP_DISTANCE = 0.3  # [m] where a contract has no range of collisions
_FAILED = 0.5  # share of rays that may fail


@dataclass(frozen=True, slots=True)
class VelocityCommand:
    """A forward speed [m/s] and a yaw rate, left positive [rad/s].

    As a policy computes them: `SafetyLimits.limited` makes 0 of NaN.
    """

    linear: float = 0.0
    angular: float = 0.0

    @property
    def moves(self) -> bool:
        """True if the command is not zero."""
        return self.linear != 0.0 or self.angular != 0.0


STAND = VelocityCommand()


@checked(TaskError, after=True)
@dataclass(frozen=True, slots=True, kw_only=True)
class SafetyLimits:
    """Limits that hold whatever the policy commands.

    Raises:
        TaskError: One of them is invalid.
    """

    max_linear: float = math.inf
    """Greatest forward and backward speed [m/s]."""
    max_angular: float = math.inf
    """Greatest yaw rate to either side [rad/s]."""
    stop_distance: float = _STOP_DISTANCE
    """With anything nearer than this in the way the robot may turn, but not drive [m]; 0: never."""
    stop_angle: float = math.radians(60.0)
    """Angle from the direction of motion within which obstacles block the robot [rad]."""
    scan_timeout: float = 0.4
    """Without a scan for so long, the robot stands still [s]."""
    odometry_timeout: float = 0.4
    """Likewise without odometry [s]."""

    def __post_init__(self) -> None:
        for name in ("max_linear", "max_angular", "scan_timeout", "odometry_timeout"):
            if not getattr(self, name) > 0.0:
                raise TaskError(f"{name} must be above 0, not {getattr(self, name)}")
        if not (self.stop_distance >= 0.0 and 0.0 < self.stop_angle <= math.pi):
            raise TaskError("stop_distance must be 0 or more, stop_angle between 0 and pi")

    @staticmethod
    def default_stop_distance(contract: PolicyContract) -> float:
        """Return a suitable stop distance [m]: the collision range of the contract plus a margin."""
        if contract.collision_range is None:
            return _STOP_DISTANCE
        return contract.collision_range + _MARGIN

    def limited(self, command: VelocityCommand) -> VelocityCommand:
        """Return the command within the greatest speeds; numbers that are none become 0."""
        return VelocityCommand(
            _cut(command.linear, self.max_linear), _cut(command.angular, self.max_angular)
        )

    def blocked(
        self, command: VelocityCommand, scan: ScanReading, *, turned: float = 0.0
    ) -> float | None:
        """Return the nearest thing in the way of a command, if it is nearer than it may be [m].

        Args:
            command: Command of the robot.
            scan: The newest; all rays count, not only those that the policy sees.
            turned: Yaw of the lidar, to the left [rad].
        """
        angles = scan.angles(turned)
        if command.linear == 0.0 or self.stop_distance == 0.0:
            return None
        ahead = 0.0 if command.linear > 0.0 else math.pi
        away = np.abs(np.angle(np.exp(1j * (angles - ahead))))
        near = scan.measured() | np.isneginf(scan.ranges)
        ranges = np.where(near & (away <= self.stop_angle), scan.ranges, np.inf)
        nearest = max(float(ranges.min(initial=np.inf)), 0.0)
        return nearest if nearest < self.stop_distance else None


def unusable(scan: ScanReading) -> str | None:
    """Return why the robot cannot drive by a scan, or None: of NaN no obstacle is near or ahead."""
    if len(scan.ranges) == 0 or float(scan.failed().mean()) > _FAILED:
        return "scan unusable: most rays failed"
    angles = scan.angle_min, scan.angle_increment
    if not all(map(math.isfinite, angles)) or math.isnan(scan.range_min + scan.range_max):
        return "scan unusable: its angles or limits are not numbers"
    return None


def lost(odometry: OdometryReading) -> str | None:
    """Return why the robot cannot drive by odometry, or None."""
    finite = all(math.isfinite(getattr(odometry, each.name)) for each in fields(odometry))
    return None if finite else "odometry unusable: not finite numbers"


def _cut(value: float, most: float) -> float:
    return min(max(value, -most), most) if math.isfinite(value) else 0.0
