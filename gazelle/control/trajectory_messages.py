"""Judge trajectories that come to a controller, and turn them into waypoints on its clock."""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats, Indices
from gazelle.control.trajectory import Waypoints
from gazelle.control.values import INVALID_GOAL, INVALID_JOINTS, JointTrajectory, TrajectoryPoint
from gazelle.errors import ControlError, ControlWarning, did_you_mean


class TrajectoryRefusedError(ControlError):
    """A trajectory cannot be followed.

    Attributes:
        code: ``error_code`` of control_msgs/FollowJointTrajectory.
    """

    def __init__(self, message: str, code: int = INVALID_GOAL, hint: str | None = None) -> None:
        super().__init__(message, hint=hint)
        self.code = code


def columns_of(trajectory: JointTrajectory, names: Sequence[str], *, partial: bool) -> Indices:
    """Return the indices of a trajectory's joints among the controller's, shape (n,).

    Raises:
        TrajectoryRefusedError: There are no names, one is unknown or there twice, or some are missing
            that must not be.
    """
    joints = tuple(names) if trajectory.names is None else trajectory.names
    if not joints:
        raise TrajectoryRefusedError("the goal names no joints", INVALID_JOINTS)
    unknown = [name for name in joints if name not in names]
    if unknown:
        raise TrajectoryRefusedError(
            f"joints on incoming goal don't match the controller joints: there is no '{unknown[0]}'",
            INVALID_JOINTS,
            did_you_mean(unknown[0], names),
        )
    if len(set(joints)) != len(joints):
        raise TrajectoryRefusedError("a joint is named twice", INVALID_JOINTS)
    if len(joints) != len(names) and not partial:
        missing = ", ".join(name for name in names if name not in joints)
        raise TrajectoryRefusedError(
            f"joints on incoming goal don't match the controller joints: without {missing}",
            INVALID_JOINTS,
            "set allow_partial_joints_goal to move some of them",
        )
    return np.array([list(names).index(name) for name in joints], np.intp)


def check_points(trajectory: JointTrajectory, width: int) -> None:
    """Check that the points can be followed.

    Raises:
        TrajectoryRefusedError: Times do not rise, or there are more or fewer values than joints.
    """
    before = -math.inf
    for number, point in enumerate(trajectory.points):
        if not point.time > before:
            raise TrajectoryRefusedError(
                f"trajectory message contains waypoints that are not strictly increasing in time: "
                f"point {number} at {point.time:g} s"
            )
        before = point.time
        for what in ("positions", "velocities", "accelerations"):
            values = getattr(point, what)
            if len(values) != width and (values or what == "positions"):
                raise TrajectoryRefusedError(
                    f"point {number} of the trajectory has {len(values)} {what} for {width} joints"
                )
            if not all(math.isfinite(value) for value in values):
                raise TrajectoryRefusedError(
                    f"{what} of point {number} of the trajectory are not finite"
                )


def waypoints(
    trajectory: JointTrajectory, joints: Indices, begin: float, now: float, controller: str
) -> Waypoints:
    """Return the points that are still to come.

    Args:
        trajectory: Checked.
        joints: From ``columns_of``.
        begin: Start on the controller's clock [s].
        now: Of the next update [s].
        controller: Name of the controller, for messages.

    Raises:
        TrajectoryRefusedError: All points are over.
    """
    left = [point for point in trajectory.points if begin + point.time > now]
    gone = len(trajectory.points) - len(left)
    if not left:
        late = now - begin - trajectory.points[-1].time
        raise TrajectoryRefusedError(
            f"dropping all {gone} trajectory point(s), as they occur before the current time; "
            f"last point is {late:.6f} s in the past"
        )
    silent = gone == 1 and not trajectory.stamp and trajectory.points[0].time == 0.0
    if gone and not silent:
        text = (
            f"controller '{controller}': dropping first {gone} trajectory point(s) out of "
            f"{len(trajectory.points)}, as they occur before the current time; first valid point will be "
            f"reached in {begin + left[0].time - now:.3f} s"
        )
        warnings.warn(ControlWarning(text), stacklevel=2)
    return Waypoints(
        np.array([begin + point.time for point in left]),
        _column(left, "positions", len(joints)),
        _column(left, "velocities", len(joints)),
        _column(left, "accelerations", len(joints)),
        joints,
    )


def _column(points: Sequence[TrajectoryPoint], what: str, width: int) -> Floats:
    rows = [getattr(point, what) or (math.nan,) * width for point in points]
    return np.array(rows, np.float64).reshape(len(points), width)
