"""A laser scan as arrays, and its points in other frames while the laser moves."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Protocol

import numpy as np

from gazelle_ros.base.array_types import Bools, Floats
from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import sensor_msgs, std_msgs
from gazelle_ros.tf import FrameTree, StampedTransform
from gazelle_ros.time import Time


@dataclass(frozen=True, slots=True)
class ScanMotion:
    """Transforms of a scan to a frame, at the times of its first and its last beam."""

    first: StampedTransform
    last: StampedTransform

    def at(self, stamps: Floats) -> tuple[Floats, Floats]:
        """Return translations (n, 3) and unit quaternions (n, 4) at times [ns], shape (n,)."""
        span = self.last.stamp - self.first.stamp
        ratio = (stamps - self.first.stamp) / span if span else np.zeros(len(stamps))
        ends = [
            (np.array(each.translation), np.array(each.rotation))
            for each in (self.first, self.last)
        ]
        (place, turn), (place_after, turn_after) = ends
        if turn @ turn_after < 0.0:
            turn_after = -turn_after  # the same rotation, on the shorter way
        turns = turn + ratio[:, None] * (turn_after - turn)
        turns /= np.linalg.norm(turns, axis=1, keepdims=True)
        return place + ratio[:, None] * (place_after - place), turns


@dataclass(frozen=True, slots=True)
class BeamScan:
    """A laser scan.

    Attributes:
        ranges: Of the beams [m], shape (n,).
        intensities: Shape (n,) or shorter.
        angle_min: Of the first beam [rad].
        angle_increment: Between beams [rad].
        angle_max: Of the last beam, as the scan says [rad].
        range_min: Least valid range [m].
        range_max: Greatest valid range [m].
        stamp: Time of the first beam [ns].
        time_increment: Between beams [s].
        scan_time: Between scans [s].
        frame: Of the laser.
        motions: To other frames.
    """

    ranges: Floats
    intensities: Floats
    angle_min: float
    angle_increment: float
    angle_max: float = 0.0
    range_min: float = 0.0
    range_max: float = 100.0
    stamp: int = 0
    time_increment: float = 0.0
    scan_time: float = 0.0
    frame: str = ""
    motions: Mapping[str, ScanMotion] = field(default_factory=dict)

    @property
    def angles(self) -> Floats:
        """Angles of the beams [rad], shape (n,), added up one by one as in the original."""
        steps = np.full(len(self.ranges), self.angle_increment)
        steps[:1] = self.angle_min
        return np.add.accumulate(steps)

    @property
    def last_stamp(self) -> int:
        """Time of the last beam [ns]."""
        return self.stamp + round(max(len(self.ranges) - 1, 0) * self.time_increment * SECOND)

    def with_ranges(self, chosen: Bools, value: float) -> BeamScan:
        """Return the scan with another range of some beams."""
        return replace(self, ranges=np.where(chosen, value, self.ranges))

    def cleared(self, chosen: Bools) -> BeamScan:
        """Return the scan without some beams: out of range, and without intensity."""
        count = len(self.intensities)
        dark = np.where(chosen[:count], 0.0, self.intensities[: len(chosen)])
        return replace(self.with_ranges(chosen, self.range_max + 1.0), intensities=dark)

    def points_in(self, frame: str) -> Floats:
        """Return the ends of the beams in another frame [m], shape (n, 3); NaN out of range."""
        angles, ranges = self.angles, self.ranges
        valid = (ranges >= self.range_min) & (ranges < self.range_max)
        away = np.where(valid, ranges, np.nan)
        ends = np.stack([away * np.cos(angles), away * np.sin(angles), 0.0 * away], axis=-1)
        stamps = self.stamp + np.arange(len(ranges)) * (self.time_increment * SECOND)
        places, turns = self.motions[frame].at(np.asarray(stamps, np.float64))
        axis, real = turns[:, :3], turns[:, 3:]
        turned = ends + 2.0 * np.cross(axis, np.cross(axis, ends) + real * ends)
        found: Floats = turned + places
        return found

    def message(self) -> sensor_msgs.msg.LaserScan:
        """Return it as a ``LaserScan``."""
        return sensor_msgs.msg.LaserScan(
            header=std_msgs.msg.Header(stamp=Time(nsecs=self.stamp), frame_id=self.frame),
            angle_min=self.angle_min,
            angle_max=self.angle_max,
            angle_increment=self.angle_increment,
            time_increment=self.time_increment,
            scan_time=self.scan_time,
            range_min=self.range_min,
            range_max=self.range_max,
            ranges=self.ranges,
            intensities=self.intensities,
        )


class ScanFilter(Protocol):
    """A filter of scans."""

    def apply(self, scan: BeamScan) -> BeamScan:
        """Return a scan, filtered.

        Raises:
            ValueError: It cannot be filtered.
        """


def beam_scan(message: Any) -> BeamScan:
    """Return a ``LaserScan`` as arrays, without motions."""
    return BeamScan(
        ranges=np.asarray(message.ranges, np.float64),
        intensities=np.asarray(message.intensities, np.float64),
        angle_min=message.angle_min,
        angle_increment=message.angle_increment,
        angle_max=message.angle_max,
        range_min=message.range_min,
        range_max=message.range_max,
        stamp=message.header.stamp.to_nsec(),
        time_increment=message.time_increment,
        scan_time=message.scan_time,
        frame=message.header.frame_id,
    )


def with_motions(
    scan: BeamScan,
    tree: FrameTree,
    frames: Collection[str],
    known: Mapping[str, ScanMotion] | None = None,
) -> BeamScan:
    """Return a scan with its motions to some frames.

    Args:
        scan: A scan.
        tree: Frames that are known.
        frames: Frames that the filters of the scan need.
        known: More motions, by frame.

    Raises:
        TransformException: One is not known.
    """
    own, found = scan.frame.strip("/"), dict(known or {})
    for frame in frames:
        target = frame.strip("/")
        ends = [tree.lookup(target, own, each) for each in (scan.stamp, scan.last_stamp)]
        found[frame] = ScanMotion(*ends)
    return replace(scan, motions=found)
