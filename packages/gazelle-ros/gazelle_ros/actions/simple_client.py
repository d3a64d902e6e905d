"""A client that follows one goal at a time."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle_ros.actions.client import ActionClient, ClientGoalHandle
from gazelle_ros.actions.spec import wait
from gazelle_ros.actions.states import CommState, GoalStatus, SimpleGoalState
from gazelle_ros.messages import Message
from gazelle_ros.time import Duration, Time

if TYPE_CHECKING:
    from gazelle_ros.node import Node

_LOG = logging.getLogger("gazelle.ros.actions")
_FOREVER = Duration(0)
_SEEN_AS = {
    GoalStatus.RECALLING: GoalStatus.PENDING,
    GoalStatus.PREEMPTING: GoalStatus.ACTIVE,
}
Timeout = Duration | float | None


class SimpleActionClient:
    """Follows one goal at a time; a new one takes the place of the old.

    Args:
        node: Node of the client.
        name: Of the action.
        spec: The message class of the action.

    Raises:
        ActionException: `spec` is no action.
    """

    def __init__(self, node: Node, name: str, spec: type[Message]) -> None:
        self.node = node
        self.action_client = ActionClient(node, name, spec)
        self.simple_state = SimpleGoalState.DONE
        self.gh: ClientGoalHandle | None = None
        self.done_condition = threading.Condition()
        self.done_cb: Callable[[int, Any], Any] | None = None
        self.active_cb: Callable[[], Any] | None = None
        self.feedback_cb: Callable[[Any], Any] | None = None

    def wait_for_server(self, timeout: Timeout = _FOREVER) -> bool:
        """Wait for the server; 0 for ever. Whether it is there."""
        return self.action_client.wait_for_server(timeout)

    def send_goal(
        self,
        goal: Message,
        done_cb: Callable[[int, Any], Any] | None = None,
        active_cb: Callable[[], Any] | None = None,
        feedback_cb: Callable[[Any], Any] | None = None,
    ) -> None:
        """Send a goal.

        Args:
            goal: Goal.
            done_cb: Called at the end with the `GoalStatus` and the result.
            active_cb: Called when work begins.
            feedback_cb: Called with each feedback.
        """
        self.stop_tracking_goal()
        self.done_cb, self.active_cb, self.feedback_cb = done_cb, active_cb, feedback_cb
        self.simple_state = SimpleGoalState.PENDING
        self.gh = self.action_client.send_goal(goal, self._changed, self._fed_back)

    def send_goal_and_wait(
        self,
        goal: Message,
        execute_timeout: Timeout = _FOREVER,
        preempt_timeout: Timeout = _FOREVER,
    ) -> int:
        """Send a goal and wait for its end; cancel it if that does not come in time.

        Args:
            goal: Goal.
            execute_timeout: The longest wait for the result; 0 for ever.
            preempt_timeout: The longest wait after cancelling; 0 for ever.

        Returns:
            The `GoalStatus`.
        """
        self.send_goal(goal)
        if not self.wait_for_result(execute_timeout):
            _LOG.debug("Canceling goal")
            self.cancel_goal()
            if not self.wait_for_result(preempt_timeout):
                _LOG.debug("Preempt did not finish in time")
        return self.get_state()

    def wait_for_result(self, timeout: Timeout = _FOREVER) -> bool:
        """Wait for the end of the goal; 0 for ever. Whether it came."""
        if self.gh is None:
            _LOG.error("Called wait_for_goal_to_finish when no goal exists")
            return False
        return wait(self.node, self.done_condition, self._is_done, timeout)

    def get_result(self) -> Any:
        """Return the result of the goal; None before."""
        if self.gh is None:
            _LOG.error("Called get_result when no goal is running")
            return None
        return self.gh.get_result()

    def get_state(self) -> int:
        """Return the `GoalStatus`: pending, active, or terminal; lost if there is no goal."""
        if self.gh is None:
            return GoalStatus.LOST
        status = self.gh.get_goal_status()
        return _SEEN_AS.get(status, status)

    def get_goal_status_text(self) -> str:
        """Return the text that the server sent with the status."""
        if self.gh is None:
            _LOG.error("Called get_goal_status_text when no goal is running")
            return "ERROR: Called get_goal_status_text when no goal is running"
        return self.gh.get_goal_status_text()

    def cancel_all_goals(self) -> None:
        """Request the server to cancel all goals, including those of other clients."""
        self.action_client.cancel_all_goals()

    def cancel_goals_at_and_before_time(self, time: Time) -> None:
        """Request the server to cancel all goals stamped with a time or earlier."""
        self.action_client.cancel_goals_at_and_before_time(time)

    def cancel_goal(self) -> None:
        """Request the server to cancel the goal."""
        if self.gh is not None:
            self.gh.cancel()

    def stop_tracking_goal(self) -> None:
        """Stop tracking the goal, which continues."""
        self.gh = None

    def _is_done(self) -> bool:
        return self.simple_state == SimpleGoalState.DONE

    def _changed(self, handle: ClientGoalHandle) -> None:
        state = handle.get_comm_state()
        if self.gh is not None and handle != self.gh:
            return  # a goal that is followed no more
        if state in {CommState.ACTIVE, CommState.PREEMPTING}:
            if self.simple_state == SimpleGoalState.PENDING:
                self.simple_state = SimpleGoalState.ACTIVE
                if self.active_cb is not None:
                    self.active_cb()
        elif state == CommState.DONE:
            self._finish(handle)

    def _finish(self, handle: ClientGoalHandle) -> None:
        if self.simple_state == SimpleGoalState.DONE:
            _LOG.error("SimpleActionClient received DONE twice")
            return
        self.simple_state = SimpleGoalState.DONE
        if self.done_cb is not None:
            self.done_cb(handle.get_goal_status(), handle.get_result())
        with self.done_condition:
            self.done_condition.notify_all()

    def _fed_back(self, handle: ClientGoalHandle, feedback: Message) -> None:
        if (self.gh is None or handle == self.gh) and self.feedback_cb is not None:
            self.feedback_cb(feedback)
