"""Limits of planning requests."""

from __future__ import annotations

import math
from collections.abc import Sequence

from gazelle.description import Pose
from gazelle.errors import PlanningError

MAX_STEPS = 100_000
"""Steps of a Cartesian path."""

MAX_TRAJECTORY_POINTS = 100_000
"""Points of a trajectory: at twenty a second, 83 minutes."""


def checked_poses(poses: object) -> list[Pose]:
    """Return the poses of a path.

    Raises:
        PlanningError: There are none, or one is no pose.
    """
    listed = list(poses) if isinstance(poses, Sequence) else []
    if not listed:
        raise PlanningError(f"a path needs a list of one pose or more, not {poses!r}")
    for number, pose in enumerate(listed):
        if not isinstance(pose, Pose):
            raise PlanningError(f"pose {number} of a path is not a gazelle.Pose: {pose!r}")
    return listed


def checked_steps(steps: float, step: float) -> int:
    """Return a number of steps, rounded up, at least one.

    Args:
        steps: Number of steps on a straight path.
        step: Length of each step, for the message [m].

    Raises:
        PlanningError: They are too many.
    """
    if not steps <= MAX_STEPS:
        raise PlanningError(
            f"a path would take {steps:.3g} steps of {step:g} m, more than the limit of "
            f"{MAX_STEPS:,}",
            hint="take longer steps, or nearer poses",
        )
    return max(1, math.ceil(steps))


def checked_duration(duration: float, interval: float) -> int:
    """Return a number of intervals, rounded up.

    Args:
        duration: Of a trajectory [s].
        interval: Between its points [s].

    Raises:
        PlanningError: They are too many.
    """
    if not duration / interval <= MAX_TRAJECTORY_POINTS:
        raise PlanningError(
            f"a trajectory would take {duration:.3g} s, {duration / interval:.3g} points, more than "
            f"the limit of {MAX_TRAJECTORY_POINTS:,}",
            hint="allow higher velocities and accelerations, or take nearer points",
        )
    return math.ceil(duration / interval)
