"""Pose from the changes of several poses: the law of ``robot_pose_ekf``.

Wheel odometry, visual odometry and the heading of an IMU count by their changes since the last estimate,
roll and pitch of an IMU and places of GPS as they are. Nothing is predicted: before each update the old
estimate becomes vague. All measurements of an update are linear, so they are added as information.
"""

from __future__ import annotations

import bisect
from collections.abc import Collection
from dataclasses import dataclass, field, fields

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Pose
from gazelle.engines.limits import NANOSECONDS
from gazelle.errors import Error
from gazelle.navigation.angles import wrapped_all
from gazelle_ros.base.parameter_values import Values, fields_of, warn_of_unknown
from gazelle_ros.base.rotations import mix, slerp

_KEPT = 10 * NANOSECONDS
"""Age of the oldest pose that is kept [ns]."""
_FORGOTTEN = 1e6 * np.eye(6)
"""Added to the covariance before each update [m^2 and rad^2]."""
_PRIOR = 1e-6 * np.eye(6)
_ODOMETRY, _IMU, _GPS = (0, 1, 5), (3, 4, 5), (0, 1, 2)
_ROLL, _YAW = 3, 5


@dataclass(frozen=True, slots=True)
class PoseFusionSettings:
    """Parameters; names and defaults are those of ``robot_pose_ekf``."""

    output_frame: str = "odom_combined"
    base_footprint_frame: str = "base_footprint"
    freq: float = 30.0
    sensor_timeout: float = 1.0
    odom_used: bool = True
    imu_used: bool = True
    vo_used: bool = True
    gps_used: bool = False
    debug: bool = False
    self_diagnose: bool = False

    @classmethod
    def read(cls, values: Values) -> PoseFusionSettings:
        """Read the parameters; unknown ones are logged.

        Raises:
            Error: One is of the wrong kind, or the frames are the same.
        """
        warn_of_unknown("~", values, [*(each.name for each in fields(cls)), "tf_prefix"])
        made = cls(**fields_of(cls, values))
        if made.output_frame == made.base_footprint_frame:
            raise Error(f"output_frame and base_footprint_frame are both '{made.output_frame}'")
        return made


@dataclass(slots=True)
class PoseTrack:
    """Poses of a sensor over time.

    Attributes:
        covariance: Of the last one: of a pose, of three angles (imu) or of a place (gps).
        before: Pose at the last update; None if it was not used then.
    """

    covariance: Floats = field(default_factory=lambda: np.eye(6))
    before: Pose | None = None
    _poses: list[tuple[int, Pose]] = field(default_factory=list)

    def add(self, stamp: int, pose: Pose, covariance: Floats) -> None:
        """Store a pose of a time [ns]."""
        self.covariance = covariance
        bisect.insort(self._poses, (stamp, pose), key=_stamp)
        oldest = bisect.bisect_left(self._poses, self._poses[-1][0] - _KEPT, key=_stamp)
        del self._poses[:oldest]

    def at(self, stamp: int) -> Pose | None:
        """Return the pose at a time [ns], interpolated; None before the first and after the last."""
        after = bisect.bisect_left(self._poses, stamp, key=_stamp)
        if after == len(self._poses):
            return None
        end, pose = self._poses[after]
        if end == stamp:
            return pose
        if after == 0:
            return None
        begin, before = self._poses[after - 1]
        return _between(before, pose, (stamp - begin) / (end - begin))


class PoseFusion:
    """Estimate of position and fixed-axis angles.

    Attributes:
        pose: Estimate; None before it begins.
        covariance: Shape (6, 6).
        stamp: Of the estimate [ns].
    """

    def __init__(self) -> None:
        self.pose: Pose | None = None
        self.covariance = _PRIOR
        self.stamp = 0
        self._tracks = {name: PoseTrack() for name in ("odom", "imu", "vo", "gps")}

    def begin(self, pose: Pose, stamp: int) -> None:
        """Set the estimate."""
        self.pose, self.covariance, self.stamp = pose, _PRIOR, stamp

    def add(self, sensor: str, stamp: int, pose: Pose, covariance: Floats) -> bool:
        """Store a pose of a sensor; returns False if a variance is not positive.

        Args:
            sensor: odom, imu, vo or gps.
            stamp: [ns].
            pose: Measured.
            covariance: Of a pose, shape (6, 6), or of angles or place, shape (3, 3).
        """
        if not (covariance.diagonal() > 0.0).all():
            return False
        self._tracks[sensor].add(stamp, pose, covariance)
        return True

    def update(self, sensors: Collection[str], stamp: int) -> bool:
        """Update the estimate to a time; returns False if a sensor's pose is not known then.

        Args:
            sensors: Those that are used. A sensor that was not used last time counts from the next.
            stamp: Later than the last one [ns].
        """
        if self.pose is None or stamp <= self.stamp:
            return False
        poses = {name: self._tracks[name].at(stamp) for name in sensors}
        if None in poses.values():
            return False
        scale = ((stamp - self.stamp) / NANOSECONDS) ** 2
        state = np.array((*self.pose.position, *self.pose.rpy))
        information = np.linalg.inv(self.covariance + _FORGOTTEN)
        vector = np.zeros(6)
        for name, track in self._tracks.items():
            pose = poses.get(name)
            before, track.before = track.before, pose
            if pose is None or before is None:
                continue
            index, values = _measured(name, self.pose, before, pose)
            noise = track.covariance
            if len(noise) > len(index):
                noise = noise[np.ix_(index, index)]
            weight = np.linalg.inv(noise * scale)
            change = values - state[list(index)]
            angles = np.array(index) >= _ROLL
            change[angles] = wrapped_all(change[angles])
            information[np.ix_(index, index)] += weight
            vector[list(index)] += weight @ change
        self.covariance = np.asarray(np.linalg.inv(information))
        self.pose = Pose(*(state + self.covariance @ vector).tolist())
        self.stamp = stamp
        return True


def _stamp(entry: tuple[int, Pose]) -> int:
    return entry[0]


def _between(first: Pose, second: Pose, share: float) -> Pose:
    """Return a pose interpolated between two, with the rotation at an even rate."""
    return Pose.from_quaternion(
        mix(first.position, second.position, share),
        slerp(first.quaternion, second.quaternion, share),
    )


def _measured(
    sensor: str, estimate: Pose, before: Pose, pose: Pose
) -> tuple[tuple[int, ...], Floats]:
    """Return the elements that a sensor measures, and their values."""
    if sensor == "gps":
        return _GPS, np.array(pose.position)
    if sensor == "odom":
        estimate = Pose(*estimate.position, 0.0, 0.0, estimate.yaw)  # it knows of a plane only
    change = estimate * (before.inverse() * pose)
    if sensor == "imu":
        return _IMU, np.array((pose.roll, pose.pitch, change.yaw))
    values = np.array((*change.position, *change.rpy))
    index = _ODOMETRY if sensor == "odom" else tuple(range(6))
    return index, values[list(index)]
