"""Transforms of measurements: at their time, else the newest."""

from __future__ import annotations

import time

from gazelle.bridges.conversions import pose_of_transform
from gazelle.bridges.navigation.frames import GraphFrames
from gazelle.description import Pose

_LOOK_S = 0.002
_IDENTITY = Pose()


class TransformFinder:
    """Finds transforms, and notes those that are not there.

    Args:
        frames: Of the graph.
        timeout: Longest wait for a transform at the time of a measurement [s].

    Attributes:
        missing: Targets and sources between which there was no transform when one was last needed.
    """

    def __init__(self, frames: GraphFrames, timeout: float = 0.0) -> None:
        self._frames, self._timeout = frames, timeout
        self.missing: set[tuple[str, str]] = set()

    def find(self, target: str, source: str, stamp: int) -> Pose | None:
        """Return the pose of a frame in another at a time [ns], else the newest; None if unknown."""
        if target == source:
            return _IDENTITY
        found = self._frames.find(target, source, stamp)
        end = time.monotonic() + self._timeout
        while found is None and time.monotonic() < end:
            time.sleep(_LOOK_S)
            found = self._frames.find(target, source, stamp)
        found = found or self._frames.find(target, source)
        if found is None:
            self.missing.add((target, source))
            return None
        self.missing.discard((target, source))
        return pose_of_transform(found)

    def described(self) -> list[str]:
        """Return the missing transforms as text."""
        return [
            f"a transform from '{source}' to '{target}' (robot_state_publisher or a "
            "static_transform_publisher sends it)"
            for target, source in sorted(self.missing)
        ]
