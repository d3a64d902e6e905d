"""Cache of one frame: its transforms to its parent over time."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from dataclasses import dataclass
from typing import Protocol

from gazelle_ros.base.rotations import Quaternion, Vector, mix, slerp

_COMPACT = 256


@dataclass(frozen=True, slots=True)
class ParentTransform:
    """A frame in its parent.

    Attributes:
        parent: Name of the parent.
        translation: [m].
        rotation: (x, y, z, w).
    """

    parent: str
    translation: Vector
    rotation: Quaternion


class OutsideError(Exception):
    """The requested time is not held; the text says how far off it is."""


class FrameCache(Protocol):
    """The placements of one frame."""

    def insert(self, stamp: int, placement: ParentTransform) -> str:
        """Store a placement; returns why not, empty if it is stored."""

    def at(self, stamp: int) -> ParentTransform | None:
        """Return the placement at a time [ns], 0 for the latest; None if nothing is known.

        Raises:
            OutsideError: The time is outside of what is known.
        """

    def latest(self) -> tuple[int, str] | None:
        """Return time [ns] and parent of the latest placement; time 0 means at all times."""

    def span(self) -> tuple[int, int, int]:
        """Return number of placements, and the times [ns] of the oldest and the latest."""

    def clear(self) -> None:
        """Discard what may change with time."""


class StaticCache:
    """A frame that never moves."""

    __slots__ = ("_placement",)

    def __init__(self) -> None:
        self._placement: ParentTransform | None = None

    def insert(self, stamp: int, placement: ParentTransform) -> str:
        """Replace the placement."""
        del stamp
        self._placement = placement
        return ""

    def at(self, stamp: int) -> ParentTransform | None:
        """Return the placement, at any time."""
        del stamp
        return self._placement

    def latest(self) -> tuple[int, str] | None:
        """Return time 0, and the parent."""
        return (0, self._placement.parent) if self._placement else None

    def span(self) -> tuple[int, int, int]:
        """Return the span: one placement, without a time."""
        return (1, 0, 0)

    def clear(self) -> None:
        """Do nothing: static frames stay."""


class MovingCache:
    """A frame that moves: placements by time, over the last seconds.

    Args:
        length: Time to keep a placement before the latest [ns].
    """

    __slots__ = ("_first", "_length", "_placements", "_stamps")

    def __init__(self, length: int) -> None:
        self._length = length
        self._stamps: list[int] = []
        self._placements: list[ParentTransform] = []
        self._first = 0

    def insert(self, stamp: int, placement: ParentTransform) -> str:
        """Store the placement, unless it is older than all that are stored, or known already."""
        stamps = self._stamps
        if not stamps or stamp > stamps[-1]:
            stamps.append(stamp)
            self._placements.append(placement)
            self._prune(stamp - self._length)
            return ""
        if stamps[-1] > stamp + self._length:
            return (
                "TF_OLD_DATA ignoring data from the past (Possible reasons are listed at "
                "http://wiki.ros.org/tf/Errors%20explained)"
            )
        where = bisect_left(stamps, stamp, self._first)
        if where < len(stamps) and stamps[where] == stamp:
            return "TF_REPEATED_DATA ignoring data with redundant timestamp"
        stamps.insert(where, stamp)
        self._placements.insert(where, placement)
        return ""

    def _prune(self, oldest: int) -> None:
        stamps, first = self._stamps, self._first
        while stamps[first] < oldest:
            first += 1
        if first > _COMPACT:
            del stamps[:first], self._placements[:first]
            first = 0
        self._first = first

    def at(self, stamp: int) -> ParentTransform | None:
        """Return the placement at a time, between two known ones interpolated."""
        stamps, first = self._stamps, self._first
        if not stamps:
            return None
        last = stamps[-1]
        if stamp in {0, last}:
            return self._placements[-1]
        if len(stamps) - first == 1:
            raise OutsideError(
                f"Lookup would require extrapolation at time {seconds(stamp)}, "
                f"but only time {seconds(last)} is in the buffer"
            )
        if stamp > last:
            raise OutsideError(
                f"Lookup would require extrapolation {seconds(stamp - last)}s into the future.  "
                f"Requested time {seconds(stamp)} but the latest data is at time {seconds(last)}"
            )
        if stamp < stamps[first]:
            raise OutsideError(
                f"Lookup would require extrapolation {seconds(stamps[first] - stamp)}s into the "
                f"past.  Requested time {seconds(stamp)} but the earliest data is at time "
                f"{seconds(stamps[first])}"
            )
        return self._between(bisect_right(stamps, stamp, first), stamp)

    def _between(self, after: int, stamp: int) -> ParentTransform:
        before, begin = self._placements[after - 1], self._stamps[after - 1]
        if begin == stamp:
            return before
        behind, end = self._placements[after], self._stamps[after]
        if before.parent != behind.parent:
            return before
        ratio = ((stamp - begin) * 1e-9) / ((end - begin) * 1e-9)
        return ParentTransform(
            before.parent,
            mix(before.translation, behind.translation, ratio),
            slerp(before.rotation, behind.rotation, ratio),
        )

    def latest(self) -> tuple[int, str] | None:
        """Return time and parent of the latest placement."""
        return (self._stamps[-1], self._placements[-1].parent) if self._stamps else None

    def span(self) -> tuple[int, int, int]:
        """Return the number of stored transforms, and their first and last time."""
        if not self._stamps:
            return (0, 0, 0)
        return (len(self._stamps) - self._first, self._stamps[self._first], self._stamps[-1])

    def clear(self) -> None:
        """Discard everything."""
        self._stamps.clear()
        self._placements.clear()
        self._first = 0


def seconds(stamp: int) -> str:
    """Return a time [ns] as tf2 writes it."""
    return f"{stamp // 1_000_000_000}.{stamp % 1_000_000_000:09d}"
