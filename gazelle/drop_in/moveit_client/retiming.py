"""Trajectories of messages with other times."""

from __future__ import annotations

import copy

import numpy as np

from gazelle.bridges.moveit.trajectory_messages import points_of
from gazelle.drop_in.moveit_client.session import LOG
from gazelle.errors import PlanningError
from gazelle.kinematics import RobotModel
from gazelle.planning import PathLimits, parameterize
from gazelle.planning.time_parameterization import TimeAlgorithm
from gazelle_ros.msgs import moveit_msgs

_ALGORITHMS: dict[str, TimeAlgorithm] = {
    "iterative_time_parameterization": "iterative parabolic",
    # Through the same points, too; its splines of higher order are not there.
    "iterative_spline_parameterization": "iterative parabolic",
    "time_optimal_trajectory_generation": "time optimal",
}


def retimed(
    robot: RobotModel,
    message: moveit_msgs.msg.RobotTrajectory,
    velocity: float,
    acceleration: float,
    algorithm: str,
) -> moveit_msgs.msg.RobotTrajectory:
    """Return a ``moveit_msgs/RobotTrajectory`` along the same path, within limits.

    Args:
        robot: Its limits apply.
        message: The trajectory.
        velocity: Factor of the limits, within (0, 1]; 1 where it is not.
        acceleration: Likewise.
        algorithm: As MoveIt names it.

    Returns:
        The trajectory; an empty one, with a word in the log, if there is no such algorithm or the
        trajectory is of other joints.
    """
    empty = moveit_msgs.msg.RobotTrajectory()
    if algorithm not in _ALGORITHMS:
        LOG.error("Unknown time parameterization algorithm: %s", algorithm)
        return empty
    given = message.joint_trajectory
    if not given.points:
        return message
    try:
        columns = robot.columns(given.joint_names)
        bounds = [robot.variables[column].bounds for column in columns]
        limits = PathLimits(
            np.array([each.velocity for each in bounds]),
            np.array([each.acceleration for each in bounds]),
        ).scaled(_factor(velocity), _factor(acceleration))
        points = np.array([each.positions for each in given.points], np.float64)
        timed = parameterize(points, limits, _ALGORITHMS[algorithm])
    except PlanningError as error:
        LOG.error("the trajectory has no other times: %s", error)
        return empty
    made = copy.copy(message)
    made.joint_trajectory = copy.copy(given)
    made.joint_trajectory.points = points_of(timed)
    return made


def _factor(requested: float) -> float:
    return float(requested) if 0.0 < requested <= 1.0 else 1.0
