"""The node ``move_base``: to goals (http://wiki.ros.org/move_base)."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from typing import Any

import numpy as np

from gazelle.bridges.navigation.band_topics import BandTopics
from gazelle.bridges.navigation.costmap_topics import CostmapTopics
from gazelle.bridges.navigation.diagnosis import StartDiagnosis
from gazelle.bridges.navigation.frames import GraphFrames, missing_links
from gazelle.bridges.navigation.messages import (
    path_message,
    pose_of,
    stamped,
    twist_message,
    wrong_quaternion,
)
from gazelle.bridges.navigation.planner_topics import PlannerTopics
from gazelle.errors import Error
from gazelle.navigation.following import Pose2
from gazelle.navigation.move_base import GoalOutcome, RobotState, navigation_stack
from gazelle.navigation.move_base.state_machine import MoveStep
from gazelle.navigation.planners.planar import composed
from gazelle.navigation.planners.plugins import STOP, Velocity
from gazelle.navigation.planners.teb import TebPlanner
from gazelle_ros.actions import SimpleActionServer
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.clock import SECOND, Rate
from gazelle_ros.msgs import geometry_msgs, move_base_msgs, nav_msgs, std_srvs
from gazelle_ros.node import Node
from gazelle_ros.time import Time


def main(arguments: Sequence[str]) -> int:
    """Serve goals until shutdown; returns the exit code."""
    return run_node(arguments, "move_base", MoveBaseNode)


class MoveBaseNode:
    """A `NavigationStack` on a graph.

    All is done by the thread that calls `run`, once a cycle of the controller: maps and scans are
    taken, costmaps updated when due, then a step of the state machine. Services wait for a lock.

    Args:
        node: On the graph; parameters are those of ``move_base``.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        values = private_values(node)
        self.stack = navigation_stack(values)
        self._law = self.stack.move_base
        self._lock = threading.RLock()
        self._velocity: Velocity = STOP
        self.frames = GraphFrames(node)
        self.whole = CostmapTopics(node, "global_costmap", self.stack.whole, self.frames)
        self.local = CostmapTopics(node, "local_costmap", self.stack.local, self.frames)
        self._commands = node.advertise("cmd_vel", geometry_msgs.msg.Twist, queue_size=1)
        pose, path = geometry_msgs.msg.PoseStamped, nav_msgs.msg.Path
        self._current = node.advertise("~current_goal", pose, queue_size=1)
        self._recovery = node.advertise("~recovery_status", move_base_msgs.msg.RecoveryStatus)
        law = self._law.controller
        controller = law.name
        self._bands = (
            BandTopics(node, law, self.frames, self._lock) if isinstance(law, TebPlanner) else None
        )
        self._planner = PlannerTopics(node, self._law.planner, self._lock, self._in_global_frame)
        self._whole_plans = node.advertise(f"~{controller}/global_plan", path, queue_size=1)
        self._local_plans = node.advertise(f"~{controller}/local_plan", path, queue_size=1)
        self._goals = node.advertise(
            "move_base/goal", move_base_msgs.msg.MoveBaseActionGoal, queue_size=1
        )
        node.subscribe("move_base_simple/goal", pose, self._forward)
        node.subscribe("odom", nav_msgs.msg.Odometry, self._receive_odometry)
        node.serve("~make_plan", nav_msgs.srv.GetPlan, self._make_plan)
        node.serve("~clear_costmaps", std_srvs.srv.Empty, self._clear)
        self._server = SimpleActionServer(
            node, "move_base", move_base_msgs.msg.MoveBaseAction, auto_start=False
        )
        self._diagnosis = StartDiagnosis(node, self._missing)
        self._started = False

    # Cycles -------------------------------------------------------------------------------

    def run(self, stop: threading.Event) -> None:
        """Run until shutdown; the robot is stopped then."""
        rate = Rate(self._node.clock, self.stack.settings.controller_frequency, reset=True)
        try:
            while not stop.is_set() and not self._node.closed:
                self.cycle()
                rate.sleep(stop.is_set)
        finally:
            if not self._node.closed:
                self._drive(STOP)
            with self._lock:
                if self._server.is_active() and not self._node.closed:
                    self._server.set_aborted(
                        None, "Aborting on the goal because the node has been killed"
                    )

    def cycle(self) -> None:
        """Process input, update what is due, and take a step towards the goal."""
        now = self._node.clock.now()
        with self._lock:
            ready = [costmap.cycle(now) for costmap in (self.whole, self.local)]
            self._diagnosis.check(waiting=not all(ready))
            if not all(ready):
                return
            if not self._started:
                self._started = True
                self._server.start()
            self._take_goal(now)
            state = self._state()
            if state is None or self._law.goal is None:
                return
            self._send_step(self._law.update(now / SECOND, state), state, now)

    def _missing(self) -> list[str]:
        whole, local = self.stack.whole.costmap.frame, self.stack.local.costmap.frame
        base = self.stack.local.base_frame
        found = missing_links(
            self.frames.tree, whole if whole != local else "", local, base, self.local.sensor_frame
        )
        return found + self.whole.missing() + self.local.missing()

    def _state(self) -> RobotState | None:
        whole, local = self.whole.pose, self.local.pose
        if whole is None or local is None:
            return None
        return RobotState(whole, local, self._velocity)

    def _receive_odometry(self, message: nav_msgs.msg.Odometry) -> None:
        twist = message.twist.twist
        self._velocity = twist.linear.x, twist.linear.y, twist.angular.z

    # Goals --------------------------------------------------------------------------------

    def _forward(self, message: geometry_msgs.msg.PoseStamped) -> None:
        """Forward a simple goal to the action."""
        goal = move_base_msgs.msg.MoveBaseActionGoal()
        goal.header.stamp = Time(nsecs=self._node.clock.now())
        goal.goal.target_pose = message
        self._goals.publish(goal)

    def _take_goal(self, now: int) -> None:
        server = self._server
        if server.is_new_goal_available():
            goal = server.accept_new_goal()
            if goal is None:
                return
            fault = wrong_quaternion(goal.target_pose.pose.orientation)
            if fault is not None:
                self._abort("it was sent with an invalid quaternion")
                return
            found = self._in_global_frame(goal.target_pose)
            if found is None:
                self._abort("its frame is not known")
                return
            try:
                self._law.set_goal(found, now / SECOND)
            except Error:
                self._abort("its position is not finite")
                return
            self._current.publish(stamped(found, self.stack.whole.costmap.frame, now))
        if server.is_active() and server.is_preempt_requested():
            self._law.cancel()
            server.set_preempted()
            self._drive(STOP)

    def _abort(self, reason: str) -> None:
        self._law.cancel()
        self._server.set_aborted(None, f"Aborting on goal because {reason}")
        self._drive(STOP)

    def _in_global_frame(self, target: geometry_msgs.msg.PoseStamped) -> Pose2 | None:
        """Convert a ``PoseStamped`` to the frame of the global costmap; None if unknown."""
        frame = target.header.frame_id.strip("/") or self.stack.whole.costmap.frame
        to_whole = self.frames.pose(self.stack.whole.costmap.frame, frame)
        return None if to_whole is None else composed(to_whole, pose_of(target.pose))

    def _send_step(self, step: MoveStep, state: RobotState, now: int) -> None:
        """Apply and publish the result of a step."""
        whole, local = self.stack.whole.costmap.frame, self.stack.local.costmap.frame
        feedback = move_base_msgs.msg.MoveBaseFeedback()
        feedback.base_position = stamped(state.global_pose, whole, now)
        self._server.publish_feedback(feedback)
        if step.velocity is not None:
            self._drive(step.velocity)
        if step.plan is not None:
            self._planner.publish(step.plan, now)
            self._whole_plans.publish(path_message(step.plan, whole, now))
        ahead = self._law.controller.local_plan
        if ahead is not None and self._local_plans.num_connections:
            self._local_plans.publish(path_message(ahead, local, now))
        if self._bands is not None:
            self._bands.publish(now)
        if step.recovery is not None:
            self._recovery.publish(self._status(step.recovery, feedback.base_position))
        if step.outcome is GoalOutcome.SUCCEEDED:
            self._server.set_succeeded(None, step.text)
        elif step.outcome is GoalOutcome.ABORTED:
            self._server.set_aborted(None, step.text)

    def _status(
        self, recovery: tuple[int, str], pose: geometry_msgs.msg.PoseStamped
    ) -> move_base_msgs.msg.RecoveryStatus:
        status = move_base_msgs.msg.RecoveryStatus()
        status.pose_stamped = pose
        status.current_recovery_number, status.recovery_behavior_name = recovery
        status.total_number_of_recoveries = len(self._law.recoveries)
        return status

    def _drive(self, velocity: Velocity) -> None:
        self._commands.publish(twist_message(velocity))

    # Services -----------------------------------------------------------------------------

    def _make_plan(self, request: nav_msgs.srv.GetPlanRequest) -> list[nav_msgs.msg.Path]:
        """Return a plan from a start, or from the robot; empty while it has a goal."""
        now, frame = self._node.clock.now(), self.stack.whole.costmap.frame
        with self._lock:
            start = None
            if request.start.header.frame_id:
                start = self._in_global_frame(request.start)
            elif self.whole.pose is not None:
                start = self.whole.pose
            goal = self._in_global_frame(request.goal)
            if start is None or goal is None or self._law.goal is not None:
                return [path_message(np.zeros((0, 3)), frame, now)]
            plan = self._law.make_plan(start, goal, float(request.tolerance))
        return [path_message(plan, frame, now)]

    def _clear(self, request: std_srvs.srv.EmptyRequest) -> list[Any]:
        del request
        with self._lock:
            self.whole.reset()
            self.local.reset()
        return []
