"""The actions ``move_group`` and ``execute_trajectory``."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from gazelle.bridges.moveit.path_monitor import PathMonitor
from gazelle.bridges.moveit.planning_context import LOG, PlanningContext
from gazelle.bridges.moveit.planning_services import PlanningServices
from gazelle.bridges.moveit.robot_states import state_message
from gazelle.bridges.moveit.scene_services import SceneServices
from gazelle.bridges.moveit.trajectory_execution import TrajectoryExecutor
from gazelle.bridges.moveit.trajectory_messages import trajectory_message
from gazelle.errors import PlanningError
from gazelle.planning import MotionPlan, NoPlanError, PlanOutcome
from gazelle_ros.actions import SimpleActionServer
from gazelle_ros.msgs import moveit_msgs

if TYPE_CHECKING:
    from gazelle.bridges.moveit.error_codes import ActionResult

_BLOCKED = PlanOutcome.MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE
_RECOVERABLE = (PlanOutcome.PLANNING_FAILED, PlanOutcome.INVALID_MOTION_PLAN, _BLOCKED)
_REPLANS = 5
"""Number of replans where a goal allows them and gives no number, as in MoveIt."""
_LONGEST_DELAY_S = 60.0


class MoveGroupAction:
    """Plans, and goes there if that is wanted.

    Args:
        context: The robot and its scene.
        planning: Plans.
        scene: Changes the scene for a while, as goals say.
        executor: Moves.
    """

    def __init__(
        self,
        context: PlanningContext,
        planning: PlanningServices,
        scene: SceneServices,
        executor: TrajectoryExecutor,
    ) -> None:
        self._context, self._planning, self._executor = context, planning, executor
        self._scene = scene
        shown = moveit_msgs.msg.DisplayTrajectory
        self._shown = context.node.advertise(
            "~display_planned_path", shown, queue_size=10, latch=True
        )
        kind = moveit_msgs.msg.MoveGroupAction
        self._server = SimpleActionServer(context.node, "move_group", kind, self._work)

    def _work(self, goal: moveit_msgs.msg.MoveGroupGoal) -> None:
        result = moveit_msgs.msg.MoveGroupResult()
        self._publish_state("PLANNING")
        only = goal.planning_options.plan_only or not self._executor.allowed
        text = ""
        try:
            self._try_often(goal, result, only=only)
            result.error_code.val = int(PlanOutcome.SUCCESS)
        except PlanningError as error:
            LOG.error("move_group: %s", error)
            text, result.error_code.val = error.message, outcome_of(error)
        self._publish_state("IDLE")
        finish(self._server, result, text)

    def _try_often(
        self,
        goal: moveit_msgs.msg.MoveGroupGoal,
        result: moveit_msgs.msg.MoveGroupResult,
        *,
        only: bool,
    ) -> None:
        """Plan and go, and plan again as often as the goal allows where that may help."""
        options = goal.planning_options
        left = (options.replan_attempts or _REPLANS) if options.replan else 1
        while True:
            try:
                self._try(goal, result, only=only)
            except NoPlanError as error:
                left -= 1
                if left <= 0 or error.outcome not in _RECOVERABLE or self._preempted():
                    raise
                LOG.warning("move_group: replanning: %s", error)
                time.sleep(max(0.0, min(options.replan_delay, _LONGEST_DELAY_S)))
                self._publish_state("PLANNING")
            else:
                return

    def _try(
        self,
        goal: moveit_msgs.msg.MoveGroupGoal,
        result: moveit_msgs.msg.MoveGroupResult,
        *,
        only: bool,
    ) -> None:
        seen = self._scene.revision
        plan = self._plan(goal, result, from_here=not only)
        if self._preempted():
            raise NoPlanError("preempted while planning", PlanOutcome.PREEMPTED)
        if only:
            return
        self._publish_state("MONITOR")
        change = goal.planning_options.planning_scene_diff
        monitor = PathMonitor(
            self._context, self._scene, plan, seen, lambda: self._scene.changed(change)
        )
        try:
            self._executor.execute(
                result.planned_trajectory, lambda: self._preempted() or monitor.is_blocked()
            )
        except NoPlanError:
            if not monitor.blocked:
                raise
            raise NoPlanError("an obstacle moved into the path", _BLOCKED) from None
        result.executed_trajectory = result.planned_trajectory

    def _preempted(self) -> bool:
        return self._server.is_preempt_requested()

    def _plan(
        self,
        goal: moveit_msgs.msg.MoveGroupGoal,
        result: moveit_msgs.msg.MoveGroupResult,
        *,
        from_here: bool,
    ) -> MotionPlan:
        context, request = self._context, goal.request
        change = goal.planning_options.planning_scene_diff
        start = request.start_state
        if from_here and (start.joint_state.name or start.attached_collision_objects):
            LOG.warning(
                "move_group: a plan that is executed starts at the robot's state, not at the "
                "request's start_state"
            )
        plan = self._planning.plan(request, from_here=from_here, scene=self._scene.changed(change))
        result.trajectory_start = state_message(context.robot, plan.start)
        result.planned_trajectory = trajectory_message(plan, context.robot.frame)
        result.planning_time = plan.seconds
        self._shown.publish(
            moveit_msgs.msg.DisplayTrajectory(
                model_id=context.robot.model.name,
                trajectory=[result.planned_trajectory],
                trajectory_start=result.trajectory_start,
            )
        )
        return plan

    def _publish_state(self, state: str) -> None:
        feedback = moveit_msgs.msg.MoveGroupFeedback(state=state)
        self._server.publish_feedback(feedback)


class ExecuteTrajectoryAction:
    """Goes along trajectories that were planned before.

    Args:
        context: The robot.
        executor: Moves.
    """

    def __init__(self, context: PlanningContext, executor: TrajectoryExecutor) -> None:
        self._executor = executor
        kind = moveit_msgs.msg.ExecuteTrajectoryAction
        self._server = SimpleActionServer(context.node, "execute_trajectory", kind, self._work)

    def _work(self, goal: moveit_msgs.msg.ExecuteTrajectoryGoal) -> None:
        result = moveit_msgs.msg.ExecuteTrajectoryResult()
        text = ""
        try:
            if not self._executor.allowed:
                raise NoPlanError(
                    "the parameter allow_trajectory_execution is false", PlanOutcome.CONTROL_FAILED
                )
            self._publish_state("MONITOR")
            self._executor.execute(goal.trajectory, self._server.is_preempt_requested)
            result.error_code.val = int(PlanOutcome.SUCCESS)
        except PlanningError as error:
            LOG.error("execute_trajectory: %s", error)
            text, result.error_code.val = error.message, outcome_of(error)
        self._publish_state("IDLE")
        finish(self._server, result, text)

    def _publish_state(self, state: str) -> None:
        feedback = moveit_msgs.msg.ExecuteTrajectoryFeedback(state=state)
        self._server.publish_feedback(feedback)


def outcome_of(error: PlanningError) -> int:
    """Return the error code of an error."""
    outcome = error.outcome if isinstance(error, NoPlanError) else PlanOutcome.FAILURE
    return int(outcome)


def finish(server: SimpleActionServer, result: ActionResult, text: str) -> None:
    """End the active goal as its error code says."""
    if result.error_code.val == PlanOutcome.SUCCESS:
        server.set_succeeded(result, text)
    elif result.error_code.val == PlanOutcome.PREEMPTED:
        server.set_preempted(result, text)
    else:
        server.set_aborted(result, text)
