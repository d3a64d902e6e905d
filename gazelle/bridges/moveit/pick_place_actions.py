"""The actions ``pickup`` and ``place``."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Generic, TypeVar

from gazelle.array_types import Floats
from gazelle.bridges.moveit.grasp_messages import GraspReader, stage_message
from gazelle.bridges.moveit.motion_actions import finish, outcome_of
from gazelle.bridges.moveit.planning_context import LOG, PlanningContext
from gazelle.bridges.moveit.planning_services import PlanningServices
from gazelle.bridges.moveit.robot_states import state_message
from gazelle.bridges.moveit.scene_services import SceneServices
from gazelle.bridges.moveit.trajectory_execution import TrajectoryExecutor
from gazelle.errors import PlanningError
from gazelle.kinematics import JointModelGroup
from gazelle.planning import (
    ConstraintSet,
    ContactRules,
    ManipulationPlan,
    ManipulationStage,
    NoPlanError,
    PickPlacePlanner,
    PlanOptions,
    PlanOutcome,
)
from gazelle_ros.actions import SimpleActionServer
from gazelle_ros.msgs import moveit_msgs

_GoalT = TypeVar("_GoalT", "moveit_msgs.msg.PickupGoal", "moveit_msgs.msg.PlaceGoal")
_ResultT = TypeVar("_ResultT", "moveit_msgs.msg.PickupResult", "moveit_msgs.msg.PlaceResult")
_TIME = 5.0
"""To plan, where a goal gives none [s]."""


class ManipulationAction(Generic[_GoalT, _ResultT]):
    """Common base of ``pickup`` and ``place``: plan, then do one stage after another.

    Args:
        context: The robot and its scene.
        planning: Knows the planners' settings.
        scene: Shown when an object is taken or left.
        executor: Moves.

    Attributes:
        name: Of the action.
        kind: Its type, without ``Action``.
    """

    name = ""
    kind = ""

    def __init__(
        self,
        context: PlanningContext,
        planning: PlanningServices,
        scene: SceneServices,
        executor: TrajectoryExecutor,
    ) -> None:
        self.context, self._planning, self._scene, self._executor = (
            context,
            planning,
            scene,
            executor,
        )
        action = getattr(moveit_msgs.msg, f"{self.kind}Action")
        self._server = SimpleActionServer(context.node, self.name, action, self._work)

    def make(
        self, goal: _GoalT, planner: PickPlacePlanner, reader: GraspReader, rules: ContactRules
    ) -> ManipulationPlan:
        """Return a plan for a goal; its start is the scene's state."""
        raise NotImplementedError

    def choose(self, goal: _GoalT, result: _ResultT, number: int) -> None:
        """Store the chosen grasp or place in the result."""
        raise NotImplementedError

    def group_of(self, goal: _GoalT) -> tuple[JointModelGroup, str]:
        """Return the group, and the name of the end effector or an empty text."""
        return self.context.group(goal.group_name), ""

    # -- the action ----------------------------------------------------------------------

    def _work(self, goal: _GoalT) -> None:
        result: _ResultT = getattr(moveit_msgs.msg, f"{self.kind}Result")()
        self._publish_state("PLANNING")
        only, text = goal.planning_options.plan_only or not self._executor.allowed, ""
        try:
            plan = self._plan(goal, result)
            if self._server.is_preempt_requested():
                raise NoPlanError("preempted while planning", PlanOutcome.PREEMPTED)
            if not only:
                self._publish_state("MONITOR")
                self._do(plan, result.trajectory_stages)
            result.error_code.val = int(PlanOutcome.SUCCESS)
        except PlanningError as error:
            LOG.error("%s: %s", self.name, error)
            text, result.error_code.val = error.message, outcome_of(error)
        self._publish_state("IDLE")
        finish(self._server, result, text)

    def _plan(self, goal: _GoalT, result: _ResultT) -> ManipulationPlan:
        context = self.context
        group, effector = self.group_of(goal)
        context.refresh()
        with context.lock:
            state = context.current()
            rules = ContactRules(
                goal.support_surface_name,
                goal.allow_gripper_support_collision,
                tuple(getattr(goal, "attached_object_touch_links", ())),
                tuple(goal.allowed_touch_objects),
            )
            with self._scene.changed(goal.planning_options.planning_scene_diff):
                planner = PickPlacePlanner(
                    context.scene, group, effector, self._options(goal, group.name)
                )
                reader = GraspReader(context, group, state)
                plan = self.make(goal, planner, reader, rules)
        result.trajectory_start = state_message(context.robot, state)
        frame = context.robot.frame
        result.trajectory_stages = [stage_message(each, frame) for each in plan.stages]
        result.trajectory_descriptions = [each.name for each in plan.stages]
        result.planning_time = plan.seconds
        self.choose(goal, result, plan.choice)
        return plan

    def _options(self, goal: _GoalT, group: str) -> PlanOptions:
        settings = self._planning.settings
        return PlanOptions(
            planner=settings.planner(goal.planner_id, group),
            time=goal.allowed_planning_time if goal.allowed_planning_time > 0.0 else _TIME,
            segment=settings.segment(group),
        )

    def _do(
        self, plan: ManipulationPlan, messages: Sequence[moveit_msgs.msg.RobotTrajectory]
    ) -> None:
        for stage, message in zip(plan.stages, messages, strict=True):
            stop = self._server.is_preempt_requested
            try:
                self._executor.execute(message, stop, may_stall=stage.name == "grasp")
            except NoPlanError as error:
                text = f"{stage.name}: {error.message}"
                raise NoPlanError(text, error.outcome, error.hint) from None
            act = self._change(plan, stage)
            if act is not None:
                self._scene.change(act)

    def _change(
        self, plan: ManipulationPlan, stage: ManipulationStage
    ) -> Callable[[], bool] | None:
        """Return the change of the scene after a stage, if any."""
        scene = self.context.scene

        def attach() -> bool:
            scene.attach(plan.object, plan.link, sorted(plan.touch_links))
            return True

        def detach() -> bool:
            scene.detach(plan.object)
            return True

        return {"attach": attach, "detach": detach}.get(stage.then)

    def _publish_state(self, state: str) -> None:
        feedback = getattr(moveit_msgs.msg, f"{self.kind}Feedback")(state=state)
        self._server.publish_feedback(feedback)


class PickupAction(
    ManipulationAction["moveit_msgs.msg.PickupGoal", "moveit_msgs.msg.PickupResult"]
):
    """Takes an object of the scene by one of the grasps of the goal."""

    name, kind = "pickup", "Pickup"

    def group_of(self, goal: moveit_msgs.msg.PickupGoal) -> tuple[JointModelGroup, str]:
        """Return the named group; else the one with the end effector."""
        name = goal.group_name
        if not name and goal.end_effector:
            robot = self.context.robot
            carriers = [
                each.name
                for each in robot.semantics.groups
                if any(e.name == goal.end_effector for e in robot.group(each.name).effectors)
            ]
            name = carriers[0] if carriers else name
        return self.context.group(name), goal.end_effector

    def make(
        self,
        goal: moveit_msgs.msg.PickupGoal,
        planner: PickPlacePlanner,
        reader: GraspReader,
        rules: ContactRules,
    ) -> ManipulationPlan:
        """Return a plan to pick an object up."""
        grasps = [reader.grasp(each) for each in goal.possible_grasps]
        held = _constraints(self.context, goal)
        return planner.pick(goal.target_name, grasps, rules=rules, constraints=held)

    def choose(
        self, goal: moveit_msgs.msg.PickupGoal, result: moveit_msgs.msg.PickupResult, number: int
    ) -> None:
        """Store the grasp in the result."""
        result.grasp = goal.possible_grasps[number]


class PlaceAction(ManipulationAction["moveit_msgs.msg.PlaceGoal", "moveit_msgs.msg.PlaceResult"]):
    """Puts down an object that is held, at one of the places of the goal."""

    name, kind = "place", "Place"

    def make(
        self,
        goal: moveit_msgs.msg.PlaceGoal,
        planner: PickPlacePlanner,
        reader: GraspReader,
        rules: ContactRules,
    ) -> ManipulationPlan:
        """Return a plan to place an object."""
        name, held = goal.attached_object_name, [*self.context.scene.attached]
        if not name and len(held) == 1:
            name = held[0]
        places = [reader.place(each, of_tip=goal.place_eef) for each in goal.place_locations]
        constraints = _constraints(self.context, goal)
        return planner.place(name, places, rules=rules, constraints=constraints)

    def choose(
        self, goal: moveit_msgs.msg.PlaceGoal, result: moveit_msgs.msg.PlaceResult, number: int
    ) -> None:
        """Store the place in the result."""
        result.place_location = goal.place_locations[number]


def _constraints(context: PlanningContext, goal: _GoalT) -> ConstraintSet | None:
    state: Floats = context.scene.state
    return context.constraints(goal.path_constraints, state) or None
