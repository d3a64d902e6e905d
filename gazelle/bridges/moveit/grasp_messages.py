"""Grasps and places of ``moveit_msgs`` as those that planning knows."""

from __future__ import annotations

from collections.abc import Mapping

from gazelle.array_types import Floats
from gazelle.bridges.moveit.planning_context import PlanningContext
from gazelle.bridges.moveit.trajectory_messages import trajectory_message
from gazelle.description import Vector3
from gazelle.errors import PlanningError
from gazelle.kinematics import JointModelGroup
from gazelle.planning import (
    Grasp,
    GripperTranslation,
    ManipulationStage,
    NoPlanError,
    PlaceLocation,
    PlanOutcome,
)
from gazelle_ros.msgs import moveit_msgs, trajectory_msgs


class GraspReader:
    """Reads grasps and places for a group.

    Args:
        context: The robot and its frames.
        group: Group of the tip: directions along links that it moves turn with them.
        state: State of the robot, shape (variables,).
    """

    def __init__(self, context: PlanningContext, group: JointModelGroup, state: Floats) -> None:
        self._context, self._state = context, state
        self._moving = context.robot.moving(group.columns)

    def grasp(self, message: moveit_msgs.msg.Grasp) -> Grasp:
        """Convert a ``moveit_msgs/Grasp``.

        Raises:
            NoPlanError: A frame or a joint is not known, or a way has no direction.
        """
        closed = message.grasp_posture
        return Grasp(
            self._context.frames.pose(message.grasp_pose, self._state),
            self._translation(message.pre_grasp_approach),
            self._translation(message.post_grasp_retreat),
            open=self._posture(message.pre_grasp_posture),
            closed=self._posture(closed),
            effort=max(closed.points[-1].effort, default=0.0) if closed.points else 0.0,
            touches=tuple(message.allowed_touch_objects),
            quality=message.grasp_quality,
            name=message.id,
        )

    def place(self, message: moveit_msgs.msg.PlaceLocation, *, of_tip: bool) -> PlaceLocation:
        """Convert a ``moveit_msgs/PlaceLocation``; see ``grasp``."""
        return PlaceLocation(
            self._context.frames.pose(message.place_pose, self._state),
            self._translation(message.pre_place_approach),
            self._translation(message.post_place_retreat),
            open=self._posture(message.post_place_posture),
            of_tip=of_tip,
            touches=tuple(message.allowed_touch_objects),
            quality=message.quality,
            name=message.id,
        )

    def _translation(self, message: moveit_msgs.msg.GripperTranslation) -> GripperTranslation:
        vector, frame = message.direction.vector, message.direction.header.frame_id.lstrip("/")
        direction: Vector3 = (vector.x, vector.y, vector.z)
        if not any(direction) and message.desired_distance == 0.0:
            direction = (0.0, 0.0, 1.0)  # nowhere
        if frame not in self._moving:
            x, y, z = self._context.frames.find(frame, self._state).rotate(direction)
            direction, frame = (x, y, z), ""
        try:
            return GripperTranslation(
                direction, message.desired_distance, message.min_distance, frame
            )
        except PlanningError as error:
            raise NoPlanError(error.message, PlanOutcome.INVALID_GOAL_CONSTRAINTS) from None

    def _posture(self, message: trajectory_msgs.msg.JointTrajectory) -> Mapping[str, float]:
        """Return the last point of a ``trajectory_msgs/JointTrajectory``."""
        if not message.points:
            return {}
        for name in message.joint_names:
            try:
                self._context.robot.column(name)
            except PlanningError as error:
                outcome = PlanOutcome.INVALID_GOAL_CONSTRAINTS
                raise NoPlanError(error.message, outcome, error.hint) from None
        return dict(zip(message.joint_names, message.points[-1].positions, strict=False))


def stage_message(stage: ManipulationStage, frame: str) -> moveit_msgs.msg.RobotTrajectory:
    """Return a stage as ``moveit_msgs/RobotTrajectory``; of a gripper it is one point."""
    if stage.motion is not None:
        return trajectory_message(stage.motion, frame)
    message = moveit_msgs.msg.RobotTrajectory()
    joints = message.joint_trajectory
    joints.header.frame_id, joints.joint_names = frame, [*stage.posture]
    point = trajectory_msgs.msg.JointTrajectoryPoint
    effort = [stage.effort] * len(stage.posture) if stage.effort else []
    joints.points = [point(positions=[*stage.posture.values()], effort=effort)]
    return message
