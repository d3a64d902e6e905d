"""Plans: ``plan_kinematic_path``, ``compute_cartesian_path`` and ``query_planner_interface``."""

from __future__ import annotations

import math
from typing import Any

from gazelle.array_types import Floats
from gazelle.bridges.moveit.frames import pose_of_message
from gazelle.bridges.moveit.planner_settings import PIPELINE, PlannerSettings
from gazelle.bridges.moveit.planning_context import PlanningContext
from gazelle.bridges.moveit.robot_states import state_message
from gazelle.bridges.moveit.trajectory_messages import trajectory_message
from gazelle.errors import PlanningError
from gazelle.planning import (
    JumpLimits,
    MotionPlan,
    MotionPlanner,
    NoPlanError,
    PlanOptions,
    PlanOutcome,
)
from gazelle.ros.messages import load_message, load_service

_TIME = 1.0
"""To plan, where a request gives none, as in MoveIt [s]."""


class PlanningServices:
    """Answers requests for plans.

    Args:
        context: The robot and its scene.
    """

    def __init__(self, context: PlanningContext) -> None:
        self._context = context
        self.settings = PlannerSettings(context.node)
        plan = load_service("moveit_msgs/GetMotionPlan")
        query = load_service("moveit_msgs/QueryPlannerInterfaces")
        straight = load_service("moveit_msgs/GetCartesianPath")
        context.node.serve("plan_kinematic_path", plan, self._plan)
        context.node.serve("query_planner_interface", query, self._query)
        context.node.serve("compute_cartesian_path", straight, self._cartesian)

    # -- plans ---------------------------------------------------------------------------

    def plan(self, request: Any, *, start: Floats | None = None) -> MotionPlan:
        """A plan for a ``moveit_msgs/MotionPlanRequest``; hold the context's lock.

        Args:
            request: The request; any of its goals will do.
            start: Where it begins, shape (variables,); what the request says if None.

        Raises:
            NoPlanError: There is none, and why.
        """
        context = self._context
        group = context.group(request.group_name)
        state = context.state(request.start_state) if start is None else start
        if not request.goal_constraints:
            raise NoPlanError("there is no goal", PlanOutcome.INVALID_GOAL_CONSTRAINTS)
        held = context.constraints(request.path_constraints, state)
        planner = MotionPlanner(context.scene, group, self._options(request, group.name))
        failure: NoPlanError | None = None
        for each in request.goal_constraints:
            try:
                goal = context.constraints(each, state)
                return planner.plan(goal, start=state, constraints=held or None)
            except NoPlanError as error:
                failure = failure or error
            except PlanningError as error:
                outcome = PlanOutcome.INVALID_GOAL_CONSTRAINTS
                failure = failure or NoPlanError(error.message, outcome, error.hint)
        raise failure or NoPlanError("there is no goal", PlanOutcome.INVALID_GOAL_CONSTRAINTS)

    def _options(self, request: Any, group: str) -> PlanOptions:
        return PlanOptions(
            planner=self.settings.planner(request.planner_id, group),
            time=request.allowed_planning_time if request.allowed_planning_time > 0.0 else _TIME,
            velocity=_factor(request.max_velocity_scaling_factor),
            acceleration=_factor(request.max_acceleration_scaling_factor),
            segment=self.settings.segment(group),
        )

    def _plan(self, request: Any) -> Any:
        made: Any = load_service("moveit_msgs/GetMotionPlan")._response_class()
        response, context = made.motion_plan_response, self._context
        response.group_name = request.motion_plan_request.group_name

        def act(answer: Any) -> None:
            plan = self.plan(request.motion_plan_request)
            answer.trajectory_start = state_message(context.robot, plan.start)
            answer.trajectory = trajectory_message(plan, context.robot.frame)
            answer.planning_time = plan.seconds

        context.refresh()
        context.answer(response, act, "plan_kinematic_path")
        return made

    def _query(self, _request: Any) -> Any:
        groups = [group.name for group in self._context.robot.semantics.groups]
        made: Any = load_message("moveit_msgs/PlannerInterfaceDescription")
        own = made(name="OMPL", pipeline_id=PIPELINE, planner_ids=self.settings.names(groups))
        return {"planner_interfaces": [own]}

    # -- straight ways -------------------------------------------------------------------

    def _cartesian(self, request: Any) -> Any:
        made: Any = load_service("moveit_msgs/GetCartesianPath")._response_class()
        self._context.refresh()
        return self._context.answer(
            made, lambda answer: self._follow(request, answer), "compute_cartesian_path"
        )

    def _follow(self, request: Any, response: Any) -> None:
        context = self._context
        group = context.group(request.group_name)
        state = context.state(request.start_state)
        base = context.frames.find(request.header.frame_id, state)
        if request.waypoints and not request.max_step > 0.0:
            raise NoPlanError("max_step must be above zero", PlanOutcome.FAILURE)
        link = request.link_name or group.tip
        if link not in context.robot.links:
            raise NoPlanError(f"there is no link '{link}'", PlanOutcome.INVALID_LINK_NAME)
        held = context.constraints(request.path_constraints, state)
        plan, path = MotionPlanner(context.scene, group).follow(
            [base * pose_of_message(each) for each in request.waypoints],
            max_step=request.max_step if request.max_step > 0.0 else 1.0,
            start=state,
            link=link,
            jumps=JumpLimits(
                revolute=request.revolute_jump_threshold or math.inf,
                prismatic=request.prismatic_jump_threshold or math.inf,
            ),
            avoid_collisions=request.avoid_collisions,
            constraints=held or None,
        )
        response.start_state = state_message(context.robot, state)
        response.solution = trajectory_message(plan, context.robot.frame)
        response.fraction = path.fraction


def _factor(asked: float) -> float:
    """A scaling factor; 1 where it is not within (0, 1], as in MoveIt."""
    return float(asked) if 0.0 < asked <= 1.0 else 1.0
