"""Plans: ``plan_kinematic_path``, ``compute_cartesian_path`` and ``query_planner_interface``."""

from __future__ import annotations

import math
from contextlib import AbstractContextManager, nullcontext
from typing import Any

from gazelle.array_types import Floats
from gazelle.bridges.conversions import pose_of_message
from gazelle.bridges.moveit.plan_choice import shortest_plan, slowed
from gazelle.bridges.moveit.planner_settings import PIPELINE, PlannerSettings
from gazelle.bridges.moveit.planning_context import PlanningContext
from gazelle.bridges.moveit.robot_states import state_message
from gazelle.bridges.moveit.trajectory_messages import trajectory_message
from gazelle.description import Pose
from gazelle.errors import PlanningError
from gazelle.kinematics import JointModelGroup
from gazelle.planning import (
    ConstraintSet,
    JumpLimits,
    MotionPlan,
    MotionPlanner,
    NoPlanError,
    PlanOptions,
    PlanOutcome,
)
from gazelle_ros.messages import load_service
from gazelle_ros.msgs import moveit_msgs

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
        plan = moveit_msgs.srv.GetMotionPlan
        query = moveit_msgs.srv.QueryPlannerInterfaces
        straight = moveit_msgs.srv.GetCartesianPath
        context.serve("plan_kinematic_path", plan, self._plan)
        context.serve("query_planner_interface", query, self._query)
        context.serve("compute_cartesian_path", straight, self._cartesian)
        for name, kind, act in (
            ("get_planner_params", "GetPlannerParams", self._get_parameters),
            ("set_planner_params", "SetPlannerParams", self._set_parameters),
        ):
            context.serve(name, load_service(f"moveit_msgs/{kind}"), act)

    # -- plans ---------------------------------------------------------------------------

    def plan(
        self,
        request: moveit_msgs.msg.MotionPlanRequest,
        *,
        from_here: bool = False,
        scene: AbstractContextManager[None] | None = None,
    ) -> MotionPlan:
        """Return a plan for a ``moveit_msgs/MotionPlanRequest``; do not hold the context's lock.

        Args:
            request: The request; any of its goals will do.
            from_here: Whether it begins where the robot is, whatever the request says.
            scene: Entered, holding the lock, while the scene is looked at.

        Raises:
            NoPlanError: There is none, and why.
        """
        context = self._context
        context.refresh()
        with context.planning:
            with context.lock, scene or nullcontext():
                group = context.group(request.group_name)
                state = context.current() if from_here else context.state(request.start_state)
                goals, failure = self._goals(request, state)
                held = context.constraints(request.path_constraints, state)
                shown = context.scene if from_here else context.scene_in(request.start_state, state)
                context.planned.follow(shown)
            return self._search(request, group, state, goals, held, failure)

    def _goals(
        self, request: moveit_msgs.msg.MotionPlanRequest, state: Floats
    ) -> tuple[list[ConstraintSet], NoPlanError | None]:
        """Return valid goals, and the error of the first invalid one."""
        goals: list[ConstraintSet] = []
        failure: NoPlanError | None = None
        for each in request.goal_constraints:
            try:
                goals.append(self._context.constraints(each, state))
            except NoPlanError as error:
                failure = failure or error
        return goals, failure

    def _search(
        self,
        request: moveit_msgs.msg.MotionPlanRequest,
        group: JointModelGroup,
        state: Floats,
        goals: list[ConstraintSet],
        held: ConstraintSet,
        failure: NoPlanError | None,
    ) -> MotionPlan:
        """Return the shortest plan of all attempts to the first goal that can be reached."""
        options = self._options(request, group.name)
        for goal in goals:
            try:
                plan = shortest_plan(
                    self._context.planned, group, goal, state, held or None, options,
                    attempts=request.num_planning_attempts,
                )  # fmt: skip
            except NoPlanError as error:
                failure = failure or error
            except PlanningError as error:
                outcome = PlanOutcome.INVALID_GOAL_CONSTRAINTS
                failure = failure or NoPlanError(error.message, outcome, error.hint)
            else:
                link = request.cartesian_speed_limited_link or group.tips[-1]
                return slowed(plan, self._context.robot, link, request.max_cartesian_speed)
        raise failure or NoPlanError("there is no goal", PlanOutcome.INVALID_GOAL_CONSTRAINTS)

    def _options(self, request: moveit_msgs.msg.MotionPlanRequest, group: str) -> PlanOptions:
        return PlanOptions(
            planner=self.settings.planner(request.planner_id, group),
            time=request.allowed_planning_time if request.allowed_planning_time > 0.0 else _TIME,
            velocity=_factor(request.max_velocity_scaling_factor),
            acceleration=_factor(request.max_acceleration_scaling_factor),
            segment=self.settings.segment(group),
        )

    def _plan(
        self, request: moveit_msgs.srv.GetMotionPlanRequest
    ) -> moveit_msgs.srv.GetMotionPlanResponse:
        made = moveit_msgs.srv.GetMotionPlanResponse()
        response, context = made.motion_plan_response, self._context
        response.group_name = request.motion_plan_request.group_name

        def act(answer: moveit_msgs.msg.MotionPlanResponse) -> None:
            plan = self.plan(request.motion_plan_request)
            answer.group_name = request.motion_plan_request.group_name
            answer.trajectory_start = state_message(context.robot, plan.start)
            answer.trajectory = trajectory_message(plan, context.robot.frame)
            answer.planning_time = plan.seconds

        context.coded(response, act, "plan_kinematic_path")
        return made

    def _query(self, _request: moveit_msgs.srv.QueryPlannerInterfacesRequest) -> dict[str, Any]:
        groups = [group.name for group in self._context.robot.semantics.groups]
        made = moveit_msgs.msg.PlannerInterfaceDescription
        own = made(name="OMPL", pipeline_id=PIPELINE, planner_ids=self.settings.names(groups))
        return {"planner_interfaces": [own]}

    def _get_parameters(self, request: moveit_msgs.srv.GetPlannerParamsRequest) -> dict[str, Any]:
        found = self.settings.parameters(request.planner_config, request.group)
        made = moveit_msgs.msg.PlannerParams(
            keys=[*found], values=[*found.values()], descriptions=[""] * len(found)
        )
        return {"params": made}

    def _set_parameters(self, request: moveit_msgs.srv.SetPlannerParamsRequest) -> dict[str, Any]:
        parameters = dict(zip(request.params.keys, request.params.values, strict=False))
        self.settings.set_parameters(
            request.planner_config, request.group, parameters, replace=request.replace
        )
        return {}

    # -- straight ways -------------------------------------------------------------------

    def _cartesian(
        self, request: moveit_msgs.srv.GetCartesianPathRequest
    ) -> moveit_msgs.srv.GetCartesianPathResponse:
        made = moveit_msgs.srv.GetCartesianPathResponse()
        return self._context.coded(
            made, lambda answer: self._follow(request, answer), "compute_cartesian_path"
        )

    def _follow(
        self,
        request: moveit_msgs.srv.GetCartesianPathRequest,
        response: moveit_msgs.srv.GetCartesianPathResponse,
    ) -> None:
        context = self._context
        context.refresh()
        with context.planning:
            with context.lock:
                group = context.group(request.group_name)
                state = context.state(request.start_state)
                base = context.frames.find(request.header.frame_id, state)
                held = context.constraints(request.path_constraints, state)
                context.planned.follow(context.scene_in(request.start_state, state))
            self._straight(request, response, group, state, base, held)

    def _straight(
        self,
        request: moveit_msgs.srv.GetCartesianPathRequest,
        response: moveit_msgs.srv.GetCartesianPathResponse,
        group: JointModelGroup,
        state: Floats,
        base: Pose,
        held: ConstraintSet,
    ) -> None:
        """Follow straight paths, holding the plans' scene."""
        context = self._context
        if request.waypoints and not request.max_step > 0.0:
            raise NoPlanError("max_step must be above zero", PlanOutcome.FAILURE)
        link = request.link_name or group.tip
        if link not in context.robot.links:
            raise NoPlanError(f"there is no link '{link}'", PlanOutcome.INVALID_LINK_NAME)
        plan, path = MotionPlanner(context.planned, group).follow(
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
        speed = request.max_cartesian_speed
        plan = slowed(plan, context.robot, request.cartesian_speed_limited_link or link, speed)
        response.start_state = state_message(context.robot, state)
        response.solution = trajectory_message(plan, context.robot.frame)
        response.fraction = path.fraction


def _factor(requested: float) -> float:
    """Return a scaling factor; 1 if it is not within (0, 1], as in MoveIt."""
    return float(requested) if 0.0 < requested <= 1.0 else 1.0
