"""The client of an action: sends goals, follows them, and asks for their end."""

from __future__ import annotations

import logging
import threading
import time
import weakref
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle_ros.actions.spec import ActionTypes, goal_id, header, wait
from gazelle_ros.actions.states import TRANSITIONS, CommState, GoalStatus, TerminalState, name_of
from gazelle_ros.messages import Message
from gazelle_ros.msgs import actionlib_msgs
from gazelle_ros.time import Duration, Time

if TYPE_CHECKING:
    from gazelle_ros.node import Node

_LOG = logging.getLogger("gazelle.ros.actions")
_QUEUE = 10
_FOREVER = Duration(0)
_UNKNOWN_S = 10.0
"""So long after a goal was sent a list of the server's may still be from before it [s]."""


class GoalMachine:
    """State machine of a client's goal.

    Args:
        client: Client of the goal.
        action_goal: Sent goal.
        transition_cb: Called with the handle whenever the state changes.
        feedback_cb: Called with the handle and the feedback.
    """

    def __init__(
        self,
        client: ActionClient,
        action_goal: Any,
        transition_cb: Callable[[Any], Any] | None,
        feedback_cb: Callable[[Any, Any], Any] | None,
    ) -> None:
        self.client = client
        self.action_goal = action_goal
        self.state = CommState.WAITING_FOR_GOAL_ACK
        self.lock = threading.RLock()
        self._sent = time.monotonic()
        self._known = False
        """True if the server has reported it."""
        self.latest_result: Any = None
        self.latest_status = actionlib_msgs.msg.GoalStatus(status=GoalStatus.PENDING)
        self._transition_cb = transition_cb
        self._feedback_cb = feedback_cb

    @property
    def name(self) -> str:
        """The goal's id."""
        return str(self.action_goal.goal_id.id)

    def transition_to(self, state: int) -> None:
        """Set the state, and call the listener."""
        self.state = state
        if self._transition_cb is not None:
            self._transition_cb(ClientGoalHandle(self))

    def update_status(self, status: actionlib_msgs.msg.GoalStatus | None) -> None:
        """Process the server's status of the goal; None if it lists none."""
        with self.lock:
            if self.state in {CommState.DONE, CommState.LOST}:
                return
            if status is None:
                known = {
                    CommState.WAITING_FOR_GOAL_ACK,
                    CommState.WAITING_FOR_RESULT,
                }
                if self.state not in known and not self._on_its_way():
                    self._lose()
                return
            self._known = True
            self.latest_status = status
            steps = TRANSITIONS[self.state].get(status.status)
            if steps is None:
                _LOG.error(
                    "Invalid goal status transition from %s to %s",
                    CommState.to_string(self.state),
                    name_of(GoalStatus, status.status),
                )
                return
            for state in steps:
                self.transition_to(state)

    def _on_its_way(self) -> bool:
        """Return whether a status list may lack the goal because the list is older."""
        return not self._known and time.monotonic() - self._sent < _UNKNOWN_S

    def _lose(self) -> None:
        # A copy: within a process the message is the server's own.
        last = self.latest_status
        self.latest_status = type(last)(last.goal_id, GoalStatus.LOST, last.text)
        self.transition_to(CommState.DONE)

    def update_result(self, action_result: Any) -> None:
        """Process the result."""
        with self.lock:
            if self.state in {CommState.DONE, CommState.LOST}:
                return
            self.latest_result = action_result
            self.update_status(action_result.status)
            self.transition_to(CommState.DONE)

    def update_feedback(self, action_feedback: Any) -> None:
        """Process feedback."""
        if self._feedback_cb is not None and self.state != CommState.DONE:
            self._feedback_cb(ClientGoalHandle(self), action_feedback.feedback)


class ClientGoalHandle:
    """A goal, for the client that sent it."""

    def __init__(self, machine: GoalMachine) -> None:
        self.comm_state_machine = machine

    def cancel(self) -> None:
        """Request the server to cancel the goal."""
        machine = self.comm_state_machine
        with machine.lock:
            machine.client.publish_cancel(machine.name)
            if machine.state != CommState.DONE:
                machine.transition_to(CommState.WAITING_FOR_CANCEL_ACK)

    def get_comm_state(self) -> int:
        """Return the `CommState`."""
        return self.comm_state_machine.state

    def get_goal_status(self) -> int:
        """Return the `GoalStatus` that the server sent last."""
        return int(self.comm_state_machine.latest_status.status)

    def get_goal_status_text(self) -> str:
        """Return the text that the server sent with the status."""
        return str(self.comm_state_machine.latest_status.text)

    def get_result(self) -> Any:
        """Return the result; None before."""
        result = self.comm_state_machine.latest_result
        return None if result is None else result.result

    def get_terminal_state(self) -> int:
        """Return the terminal state, a `TerminalState`."""
        machine = self.comm_state_machine
        with machine.lock:
            if machine.state != CommState.DONE:
                _LOG.warning("Asking for the terminal state when we're in [%s]", machine.state)
            status = int(machine.latest_status.status)
            if TerminalState.to_string(status) != "No such state":
                return status
            return TerminalState.LOST

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ClientGoalHandle):
            return NotImplemented
        return self.comm_state_machine.name == other.comm_state_machine.name

    def __hash__(self) -> int:
        return hash(self.comm_state_machine.name)


class ActionClient:
    """Sends goals to a server.

    Args:
        node: Node of the client.
        name: Of the action.
        spec: The message class of the action.

    Raises:
        ActionException: `spec` is no action.
    """

    def __init__(self, node: Node, name: str, spec: type[Message]) -> None:
        self.node = node
        self.ns = name
        self.types = ActionTypes.of(spec)
        self._machines: weakref.WeakSet[GoalMachine] = weakref.WeakSet()
        self._lock = threading.RLock()
        self._status_received = threading.Condition()
        self._status_from = ""
        self._goal_id = actionlib_msgs.msg.GoalID
        self._goal = node.advertise(f"{name}/goal", self.types.action_goal, _QUEUE)
        self._cancel = node.advertise(f"{name}/cancel", self._goal_id, _QUEUE)
        statuses = actionlib_msgs.msg.GoalStatusArray
        self._subscribers = (
            node.subscribe(f"{name}/status", statuses, self._take_status),
            node.subscribe(f"{name}/result", self.types.action_result, self._take_result),
            node.subscribe(f"{name}/feedback", self.types.action_feedback, self._take_feedback),
        )

    @property
    def connected(self) -> bool:
        """True if all five topics are connected to the server that lists goals."""
        return bool(
            self._status_from
            and self._goal.num_connections
            and self._cancel.num_connections
            and all(subscriber.num_connections for subscriber in self._subscribers)
        )

    def send_goal(
        self,
        goal: Message,
        transition_cb: Callable[[ClientGoalHandle], Any] | None = None,
        feedback_cb: Callable[[ClientGoalHandle, Any], Any] | None = None,
    ) -> ClientGoalHandle:
        """Send a goal.

        Args:
            goal: Goal.
            transition_cb: Called with the handle whenever the goal's state changes.
            feedback_cb: Called with the handle and each feedback.
        """
        message = self.types.action_goal(
            header=header(self.node.clock), goal_id=goal_id(self.node), goal=goal
        )
        machine = GoalMachine(self, message, transition_cb, feedback_cb)
        with self._lock:
            self._machines.add(machine)
        self._goal.publish(message)
        return ClientGoalHandle(machine)

    def cancel_all_goals(self) -> None:
        """Request the server to cancel all goals, including those of other clients."""
        self._cancel.publish(self._goal_id())

    def cancel_goals_at_and_before_time(self, time: Time) -> None:
        """Request the server to cancel all goals stamped with a time or earlier."""
        self._cancel.publish(self._goal_id(stamp=time))

    def publish_cancel(self, name: str) -> None:
        """Request the server to cancel the goal of an id."""
        self._cancel.publish(self._goal_id(id=name))

    def wait_for_server(self, timeout: Duration | float | None = _FOREVER) -> bool:
        """Wait for the server, in the time of the node.

        Args:
            timeout: The longest wait; 0 for ever.

        Returns:
            Whether it is there.
        """
        return wait(self.node, self._status_received, lambda: self.connected, timeout)

    wait_for_action_server_to_start = wait_for_server

    def stop(self) -> None:
        """Close the topics."""
        for each in (*self._subscribers, self._goal, self._cancel):
            each.close()

    # What comes in -----------------------------------------------------------------------------

    def _live(self) -> list[GoalMachine]:
        with self._lock:
            return list(self._machines)

    def _take_status(self, message: actionlib_msgs.msg.GoalStatusArray) -> None:
        who = str(message._connection_header.get("callerid", "?"))
        with self._status_received:
            self._status_from = who
            self._status_received.notify_all()
        statuses = {status.goal_id.id: status for status in message.status_list}
        for machine in self._live():
            machine.update_status(statuses.get(machine.name))

    def _take_result(self, message: Any) -> None:
        for machine in self._live():
            if machine.name == message.status.goal_id.id:
                machine.update_result(message)

    def _take_feedback(self, message: Any) -> None:
        for machine in self._live():
            if machine.name == message.status.goal_id.id:
                machine.update_feedback(message)
