"""Action ports of controllers as ROS action servers (http://wiki.ros.org/actionlib)."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle.bridges import message_kinds
from gazelle.bridges.control import decoding, encoding
from gazelle.bridges.conversions import ConversionContext
from gazelle.bridges.graph import TimedGraph
from gazelle.control import ActionPort, Goal, GoalState
from gazelle.control.values import (
    INVALID_GOAL,
    GripperGoal,
    GripperResult,
    TrajectoryGoal,
    TrajectoryResult,
)
from gazelle.errors import ControlError, RosError
from gazelle_ros import load_message
from gazelle_ros.actions import ActionServer, GoalStatus, ServerGoalHandle
from gazelle_ros.errors import NodeClosedError
from gazelle_ros.messages import Message
from gazelle_ros.msgs import control_msgs
from gazelle_ros.serial_queue import SerialQueue

Fill = Callable[[Any, Any, ConversionContext], None]


@dataclass(frozen=True, slots=True)
class ActionCodec:
    """Conversion of an action's goals, results and feedback to and from ROS.

    Attributes:
        action: Type of the action, without ``Action``.
        goal: The goal of a message.
        result: Fills a result.
        feedback: Fills a feedback.
        refusal: The result of a goal that cannot even be judged, with its text.
    """

    action: str
    goal: decoding.Read
    result: Fill
    feedback: Fill
    refusal: Callable[[str], Any] = lambda _text: None


def _trajectory_result(
    message: control_msgs.msg.FollowJointTrajectoryResult,
    value: TrajectoryResult,
    _view: ConversionContext,
) -> None:
    message.error_code, message.error_string = value.error_code, value.error_string


def _gripper(
    message: control_msgs.msg.GripperCommandResult, value: GripperResult, _view: ConversionContext
) -> None:
    message.position, message.effort = float(value.position), float(value.effort)
    message.stalled, message.reached_goal = bool(value.stalled), bool(value.reached_goal)


_CODECS: Mapping[type[Any], ActionCodec] = {
    TrajectoryGoal: ActionCodec(
        "control_msgs/FollowJointTrajectory",
        decoding.trajectory_goal,
        _trajectory_result,
        encoding.trajectory_state,
        lambda text: TrajectoryResult(INVALID_GOAL, text),
    ),
    GripperGoal: ActionCodec(
        "control_msgs/GripperCommand", decoding.gripper_goal, _gripper, _gripper
    ),
}


def codec_of(kind: type[Any]) -> ActionCodec:
    """Return the codec of goals of a kind; those of message classes are passed unchanged.

    Raises:
        RosError: No function is registered.
    """
    found = _CODECS.get(kind)
    name = message_kinds.name_of(kind)
    if found is None and name is not None and name.endswith("Goal"):
        fill = message_kinds.fill
        return ActionCodec(name.removesuffix("Goal"), lambda message, _: message, fill, fill)
    if found is None:
        raise RosError(
            f"goals of kind '{kind.__name__}' cannot be sent over ROS",
            hint="take the goal's class of gazelle_ros.load_message",
        )
    return found


class _GraphClock:
    """The simulated time, as a graph sees it."""

    def __init__(self, graph: TimedGraph) -> None:
        self._graph = graph

    def now(self) -> int:
        """Return the time [ns]."""
        return self._graph.now().to_nsec()


class ActionBridge:
    """A port as an action server.

    A controller's report on a goal is sent by a worker, in order, so that no thread waits for a socket
    in a step.

    Args:
        graph: Node of the action.
        topic: Full name of the action.
        port: Takes the goals.

    Raises:
        RosError: Goals of this kind cannot be sent over ROS.
    """

    def __init__(self, graph: TimedGraph, topic: str, port: ActionPort[Any]) -> None:
        self._graph, self._port = graph, port
        self._codec = codec_of(port.kind)
        self._view = ConversionContext("", graph.world, graph.stamp)
        self._goals: dict[ServerGoalHandle, Goal[Any]] = {}
        self._queue = SerialQueue(graph.node.loop, lambda work: work(), f"action {topic}")
        self._server = ActionServer(
            graph.node,
            topic,
            load_message(f"{self._codec.action}Action"),
            lambda handle: self._queue.post(lambda: self._take(handle)),
            lambda handle: self._queue.post(lambda: self._cancel(handle)),
            clock=_GraphClock(graph),
        )

    def close(self) -> None:
        """Reject new goals, and leave the graph after all reports of goals were sent.

        Goals are refused at once: a controller that is loaded again under the name gets the next.
        """
        self._server.refuse()
        self._queue.post(self._server.stop)

    def _take(self, handle: ServerGoalHandle) -> None:
        try:
            value = self._codec.goal(handle.get_goal(), self._graph)
            goal = self._port.send(value, np.array([self._graph.world]))
        except ControlError as error:
            refusal = self._codec.refusal(error.message)
            handle.set_rejected(self._result(refusal), error.message)
            return
        self._goals[handle] = goal
        goal.subscribe(self._changes(handle), self._feedback(handle))

    def _cancel(self, handle: ServerGoalHandle) -> None:
        goal = self._goals.get(handle)
        if goal is not None:
            goal.cancel()

    def _changes(self, handle: ServerGoalHandle) -> Callable[[Goal[Any]], None]:
        """Return a listener of each change of a goal's state, called by the stepping thread."""

        def changed(goal: Goal[Any]) -> None:
            state, result, text = goal.state, goal.result, goal.text
            self._queue.post(lambda: self._end_goal(handle, state, result, text))

        return changed

    def _end_goal(self, handle: ServerGoalHandle, state: GoalState, result: Any, text: str) -> None:
        new = handle.get_goal_status().status in (GoalStatus.PENDING, GoalStatus.RECALLING)
        if new and state not in (GoalState.PENDING, GoalState.REJECTED, GoalState.RECALLED):
            handle.set_accepted()
        end = {
            GoalState.PREEMPTED: handle.set_canceled,
            GoalState.RECALLED: handle.set_canceled,
            GoalState.SUCCEEDED: handle.set_succeeded,
            GoalState.ABORTED: handle.set_aborted,
            GoalState.REJECTED: handle.set_rejected,
        }.get(state)
        if end is not None:
            self._goals.pop(handle, None)
            end(self._result(result), text)

    def _result(self, value: Any) -> Message:
        message: Message = self._server.types.result()
        if value is not None:
            self._codec.result(message, value, self._view)
        return message

    def _feedback(self, handle: ServerGoalHandle) -> Callable[[Any], None]:
        def publish(value: Any) -> None:
            message = self._server.types.feedback()
            self._codec.feedback(message, value, self._view)
            self._queue.post(lambda: self._publish(handle, message))

        return publish

    @staticmethod
    def _publish(handle: ServerGoalHandle, message: Message) -> None:
        with contextlib.suppress(NodeClosedError):
            handle.publish_feedback(message)
