"""The names that stage_ros gives to topics and frames."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Naming:
    """Names of the robots of one world.

    With one robot names are plain; with several each robot has a prefix.

    Args:
        robots: The robots' names in the file, in order.
        model_names: Whether the prefix is that name, where it has no colon, and there even
            with one robot (``stageros -u``).
        slashed_frames: Whether frames with a prefix begin with ``/``, as stage_ros's do; tf2
            refuses those.
    """

    robots: Sequence[str]
    model_names: bool = False
    slashed_frames: bool = False

    def topic(self, robot: int, name: str) -> str:
        """Return a topic of a robot."""
        prefix = self._prefix(robot)
        return f"/{prefix}/{name}" if prefix else name

    def device_topic(self, robot: int, name: str, index: int, count: int) -> str:
        """Return a topic of the n-th device of a kind, of those that the robot has."""
        if count == 1:
            return self.topic(robot, name)
        prefix = self._prefix(robot)
        return f"/{prefix}/{name}_{index}" if prefix else f"/{name}_{index}"

    def frame(self, robot: int, name: str, index: int = 0, count: int = 1) -> str:
        """Return a frame of a robot, or of one of several devices of a kind."""
        whole = name if count == 1 else f"{name}_{index}"
        prefix = self._prefix(robot)
        if prefix:
            whole = f"{prefix}/{whole}"
        slashed = self.slashed_frames and (bool(prefix) or count > 1)
        return f"/{whole}" if slashed else whole

    def _prefix(self, robot: int) -> str:
        if len(self.robots) == 1 and not self.model_names:
            return ""
        name = self.robots[robot]
        return name if self.model_names and ":" not in name else f"robot_{robot}"
