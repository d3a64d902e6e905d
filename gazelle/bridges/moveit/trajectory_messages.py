"""Trajectories of plans as ``moveit_msgs/RobotTrajectory``."""

from __future__ import annotations

from gazelle.planning import MotionPlan, TimedPath
from gazelle_ros.msgs import moveit_msgs, trajectory_msgs
from gazelle_ros.time import Duration


def trajectory_message(plan: MotionPlan, frame: str) -> moveit_msgs.msg.RobotTrajectory:
    """Return a plan as a message: positions, velocities and accelerations at each time.

    Args:
        plan: The plan.
        frame: Frame of the plan.
    """
    message = moveit_msgs.msg.RobotTrajectory()
    joints = message.joint_trajectory
    joints.header.frame_id = frame
    joints.joint_names = list(plan.names)
    joints.points = points_of(plan.trajectory)
    return message


def points_of(timed: TimedPath) -> list[trajectory_msgs.msg.JointTrajectoryPoint]:
    """Return a trajectory as ``trajectory_msgs/JointTrajectoryPoint`` messages."""
    made = trajectory_msgs.msg.JointTrajectoryPoint
    return [
        made(
            positions=positions,
            velocities=velocities,
            accelerations=accelerations,
            time_from_start=Duration(nsecs=round(time * 1e9)),
        )
        for time, positions, velocities, accelerations in zip(
            timed.times.tolist(),
            timed.positions.tolist(),
            timed.velocities.tolist(),
            timed.accelerations.tolist(),
            strict=True,
        )
    ]
