"""Trajectories given to the controllers of a graph."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.bridges.moveit.controller_list import (
    FAKE,
    GRIPPER,
    TRAJECTORY,
    ActionController,
    controllers_of,
)
from gazelle.bridges.moveit.fake_controllers import FakeMotion
from gazelle.bridges.moveit.planning_context import PlanningContext
from gazelle.errors import PlanningError
from gazelle.planning import NoPlanError, PlanOutcome
from gazelle.planning.execution import DURATION_MARGIN, DURATION_SCALING, choose_controllers
from gazelle.planning.group import START_TOLERANCE
from gazelle_ros.actions import GoalStatus, SimpleActionClient
from gazelle_ros.errors import NodeClosedError
from gazelle_ros.messages import load_message
from gazelle_ros.msgs import control_msgs, moveit_msgs, std_msgs, trajectory_msgs

_LOOK_S = 0.01
_SERVER_S = 5.0
_GRIPPER_S = 5.0
"""Additional time for grippers: their plans have no times."""


class TrajectoryExecutor:
    """Has controllers follow trajectories, one at a time.

    Args:
        context: The robot.

    Attributes:
        allowed: Whether it may (``~allow_trajectory_execution``).
    """

    def __init__(self, context: PlanningContext) -> None:
        self._context = context
        node = context.node
        self.allowed = bool(node.get_param("~allow_trajectory_execution", True))
        parameters: Any = node.get_param("~trajectory_execution", {}) or {}
        self._scaling = float(
            parameters.get("allowed_execution_duration_scaling", DURATION_SCALING)
        )
        self._margin = float(parameters.get("allowed_goal_duration_margin", DURATION_MARGIN))
        self._tolerance = float(parameters.get("allowed_start_tolerance", START_TOLERANCE))
        self._clients: dict[str, SimpleActionClient] = {}
        self._fake: FakeMotion | None = None
        if node.get_param("~controller_list", None) is not None and any(
            each.kind in FAKE for each in controllers_of(node).values()
        ):
            self._fake = FakeMotion(context)
        self._one = threading.Lock()
        self._stopped = threading.Event()
        kind = std_msgs.msg.String
        node.subscribe("trajectory_execution_event", kind, self._event)

    def _event(self, message: std_msgs.msg.String) -> None:
        if message.data == "stop":
            self._stopped.set()

    def execute(
        self,
        message: moveit_msgs.msg.RobotTrajectory,
        stop: Callable[[], bool],
        *,
        may_stall: bool = False,
    ) -> None:
        """Follow a ``moveit_msgs/RobotTrajectory`` to its end.

        Args:
            message: The trajectory.
            stop: Asked all the time whether to end before.
            may_stall: Whether a gripper that something keeps from its goal has done its work.

        Raises:
            NoPlanError: It did not get there, and why.
        """
        trajectory = message.joint_trajectory
        if not trajectory.points:
            return
        with self._one:
            self._stopped.clear()
            self._context.refresh()
            try:
                known = controllers_of(self._context.node)
                joints = {name: each.joints for name, each in known.items()}
                chosen = choose_controllers(joints, tuple(trajectory.joint_names))
                kinds = [known[name].kind for name in chosen]
                if {*kinds} != {GRIPPER}:  # of those only the end counts
                    self._check_start(trajectory)
                if self._fake is not None and kinds[0] in FAKE:
                    self._fake.play(kinds[0], trajectory, lambda: stop() or self._stopped.is_set())
                    return
                clients = self._begin([known[name] for name in chosen], trajectory)
            except NoPlanError:
                raise
            except PlanningError as error:
                raise _failed(error.message) from error
            lenient = [may_stall or known[name].may_fail for name in chosen]
            spare = _GRIPPER_S if GRIPPER in kinds else 0.0
            self._wait(clients, trajectory, stop, lenient, spare)

    def _check_start(self, trajectory: trajectory_msgs.msg.JointTrajectory) -> None:
        """Check that the robot is at the start of the trajectory."""
        robot = self._context.robot
        columns = robot.columns(trajectory.joint_names)
        unknown = {*self._context.monitor.unknown} & {*trajectory.joint_names}
        if unknown:
            raise _failed(
                "no message on 'joint_states' has the positions of " + ", ".join(sorted(unknown))
            )
        there = np.array(trajectory.points[0].positions)
        if there.shape != columns.shape or not np.isfinite(there).all():
            raise _failed("the first point of the trajectory must have one position for each joint")
        away = there - self._context.monitor.current()[columns]
        for number, column in enumerate(columns):
            if robot.variables[column].endless:
                away[number] = np.remainder(away[number] + np.pi, 2.0 * np.pi) - np.pi
        worst = int(np.argmax(np.abs(away)))
        if self._tolerance > 0.0 and abs(away[worst]) > self._tolerance:
            raise _failed(
                f"joint '{trajectory.joint_names[worst]}' is {abs(away[worst]):.4f} from where the "
                f"trajectory begins, more than {self._tolerance:g}"
            )

    # -- goals ---------------------------------------------------------------------------

    def _begin(
        self, controllers: list[ActionController], trajectory: trajectory_msgs.msg.JointTrajectory
    ) -> list[SimpleActionClient]:
        """Send each its part; when one is not there, the others are stopped."""
        clients: list[SimpleActionClient] = []
        try:
            for controller in controllers:
                client = self._send(controller, trajectory)
                clients.append(client)
        except NoPlanError:
            _cancel(clients)
            raise
        return clients

    def _send(
        self, controller: ActionController, trajectory: trajectory_msgs.msg.JointTrajectory
    ) -> SimpleActionClient:
        action = load_message(f"control_msgs/{controller.kind}Action")
        if controller.action not in self._clients:
            made = SimpleActionClient(self._context.node, controller.action, action)
            self._clients[controller.action] = made
        client = self._clients[controller.action]
        if not client.wait_for_server(_SERVER_S):
            raise _failed(f"the controller's action '{controller.action}' is not available")
        goal: Any = load_message(f"control_msgs/{controller.kind}Goal")()
        if controller.kind == TRAJECTORY:
            goal.trajectory = self._part(controller, trajectory)
        elif controller.kind == GRIPPER:
            _fill_gripper(goal.command, controller, trajectory)
        client.send_goal(goal)
        return client

    def _part(
        self, controller: ActionController, trajectory: trajectory_msgs.msg.JointTrajectory
    ) -> trajectory_msgs.msg.JointTrajectory:
        """Return the part for a controller's joints; its joints that are missing are held in place."""
        made = trajectory_msgs.msg.JointTrajectory()
        made.joint_names = list(controller.joints)
        own = {name: number for number, name in enumerate(trajectory.joint_names)}
        robot, here = self._context.robot, self._context.monitor.current()
        held = {name: float(here[robot.column(name)]) for name in made.joint_names
                if name not in own}  # fmt: skip
        kind = trajectory_msgs.msg.JointTrajectoryPoint
        for point in trajectory.points:
            parts = {
                field: [
                    values[own[name]] if name in own else held[name] * (field == "positions")
                    for name in made.joint_names
                ]
                for field in ("positions", "velocities", "accelerations")
                if len(values := getattr(point, field)) == len(own)
            }
            made.points.append(kind(time_from_start=point.time_from_start, **parts))
        return made

    def _wait(
        self,
        clients: list[SimpleActionClient],
        trajectory: trajectory_msgs.msg.JointTrajectory,
        stop: Callable[[], bool],
        lenient: list[bool],
        spare: float,
    ) -> None:
        """Wait for all controllers to finish; stop all if one fails or takes too long."""
        node, pause = self._context.node, threading.Event()
        duration = trajectory.points[-1].time_from_start.to_nsec()
        limit = node.clock.now() + int(duration * self._scaling + (self._margin + spare) * 1e9)
        pairs = list(zip(clients, lenient, strict=True))
        while True:
            if all(_has_arrived(client, may_stall=stalled) for client, stalled in pairs):
                return
            failure: NoPlanError | None = None
            if stop() or self._stopped.is_set() or node.closed:
                failure = NoPlanError("the motion was stopped", PlanOutcome.PREEMPTED)
            elif node.clock.now() > limit:
                failure = NoPlanError("the motion took too long", PlanOutcome.TIMED_OUT)
            else:
                left = [
                    client
                    for client, stalled in pairs
                    if not _has_arrived(client, may_stall=stalled)
                ]
                failure = next(filter(None, map(_failure_of, left)), None)
            if failure is not None:
                _cancel(clients)
                raise failure
            pause.wait(_LOOK_S)


def _cancel(clients: list[SimpleActionClient]) -> None:
    for client in clients:
        with contextlib.suppress(NodeClosedError):
            client.cancel_goal()


def _has_arrived(client: SimpleActionClient, *, may_stall: bool) -> bool:
    """Return whether a goal is reached, or as nearly as is acceptable."""
    state = client.get_state()
    if may_stall and state == GoalStatus.ABORTED:
        return bool(getattr(client.get_result(), "stalled", False))
    return bool(state == GoalStatus.SUCCEEDED)


def _failure_of(client: SimpleActionClient) -> NoPlanError | None:
    """Return the failure of a goal; None if it has not failed."""
    state = client.get_state()
    if state in (GoalStatus.PENDING, GoalStatus.ACTIVE, GoalStatus.SUCCEEDED):
        return None
    said = client.get_goal_status_text() or getattr(client.get_result(), "error_string", "")
    name = client.action_client.ns
    if state in (GoalStatus.PREEMPTED, GoalStatus.RECALLED):
        return NoPlanError(f"'{name}' was preempted: {said}", PlanOutcome.PREEMPTED)
    return _failed(f"'{name}' failed: {said}")


def _fill_gripper(
    command: control_msgs.msg.GripperCommand,
    controller: ActionController,
    trajectory: trajectory_msgs.msg.JointTrajectory,
) -> None:
    """Set a gripper's target: the sum of the last positions of the joints it commands."""
    last, named = trajectory.points[-1], list(trajectory.joint_names)
    commanded = [named.index(name) for name in controller.commanded if name in named] or [
        next(index for index, name in enumerate(named) if name in controller.joints)
    ]
    command.position = sum(last.positions[index] for index in commanded)
    efforts = [last.effort[index] for index in commanded if len(last.effort) > index]
    command.max_effort = max(efforts, default=controller.effort)


def _failed(text: str) -> NoPlanError:
    return NoPlanError(text, PlanOutcome.CONTROL_FAILED)
