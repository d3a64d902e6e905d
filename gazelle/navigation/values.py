"""Values of navigation's ports."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.array_types import Floats


@dataclass(frozen=True, slots=True)
class GoalPose:
    """Goal pose; what drives to it refuses NaN.

    Attributes:
        x: [m].
        y: [m].
        yaw: Heading to take there [rad]; any if None.
        frame: Frame of the pose; that of the odometry if empty.
    """

    x: float
    y: float
    yaw: float | None = None
    frame: str = ""


@dataclass(frozen=True, slots=True)
class Path:
    """The remaining path, in every world.

    Attributes:
        stamp: Simulated time [ns].
        frame: Frame of the poses.
        poses: x, y [m] and heading [rad], one array of shape (n, 3) for each world.
    """

    stamp: int
    frame: str
    poses: tuple[Floats, ...]
