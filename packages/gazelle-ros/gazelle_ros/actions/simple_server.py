"""A server that works on one goal at a time; a new goal preempts the old one."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle_ros.actions.server import ActionServer, ServerGoalHandle
from gazelle_ros.actions.states import GoalStatus
from gazelle_ros.errors import report
from gazelle_ros.messages import Message
from gazelle_ros.msgs import actionlib_msgs

if TYPE_CHECKING:
    from gazelle_ros.node import Node

_LOG = logging.getLogger("gazelle.ros.actions")
_WORKED_ON = frozenset({GoalStatus.ACTIVE, GoalStatus.PREEMPTING})
_NEWER = "This goal was canceled because another goal was received by the simple action server"
_UNFINISHED = (
    "Your executeCallback did not set the goal to a terminal status. This is a bug in your "
    "ActionServer implementation. Fix your code! For now, the ActionServer will set this goal to "
    "aborted"
)


class SimpleActionServer:
    """Works on one goal at a time.

    Args:
        node: Node of the server.
        name: Of the action.
        spec: The message class of the action.
        execute_cb: Called with each goal, on a thread of its own; it ends by `set_succeeded`,
            `set_aborted` or `set_preempted`. Without it, goals are taken by `accept_new_goal`.
        auto_start: Start at once.

    Raises:
        ActionException: `spec` is no action.
    """

    def __init__(
        self,
        node: Node,
        name: str,
        spec: type[Message],
        execute_cb: Callable[[Any], Any] | None = None,
        *,
        auto_start: bool = True,
    ) -> None:
        self.node = node
        self.new_goal = False
        self.preempt_request = False
        self.new_goal_preempt_request = False
        self.goal_callback: Callable[[], Any] | None = None
        self.preempt_callback: Callable[[], Any] | None = None
        self.execute_callback = execute_cb
        self.current_goal: ServerGoalHandle | None = None
        self.next_goal: ServerGoalHandle | None = None
        self.lock = threading.RLock()
        self._news = threading.Condition(self.lock)
        self._terminate = False
        self.execute_thread: threading.Thread | None = None
        self.action_server = ActionServer(
            node, name, spec, self._on_goal, self._on_cancel, auto_start=False
        )
        if execute_cb is not None:
            self.execute_thread = threading.Thread(
                target=self._execute_goals, name=f"action {name}", daemon=True
            )
            self.execute_thread.start()
        if auto_start:
            self.start()

    def start(self) -> None:
        """Start to accept goals."""
        self.action_server.start()

    def stop(self) -> None:
        """Stop accepting goals, and end the thread."""
        with self._news:
            self._terminate = True
            self._news.notify_all()
        self.action_server.stop()

    # For the work ----------------------------------------------------------------------------

    def accept_new_goal(self) -> Any:
        """Accept the new goal, and return it; the old one is preempted.

        None if there is none. None if there is none.
        """
        with self.lock:
            if not self.new_goal or self.next_goal is None:
                _LOG.error("Attempting to accept the next goal when a new goal is not available")
                return None
            if self.is_active() and self.current_goal not in {None, self.next_goal}:
                self._current().set_canceled(None, _NEWER)
            self.current_goal, self.new_goal = self.next_goal, False
            self.preempt_request = self.new_goal_preempt_request
            self.new_goal_preempt_request = False
            self._current().set_accepted("This goal has been accepted by the simple action server")
            return self._current().get_goal()

    def is_new_goal_available(self) -> bool:
        """Return whether another goal has come."""
        return self.new_goal

    def is_preempt_requested(self) -> bool:
        """Return whether the current goal is to be preempted."""
        return self.preempt_request

    def is_active(self) -> bool:
        """Return whether there is an active goal."""
        if self.current_goal is None or not self.current_goal.get_goal_id().id:
            return False
        return self.current_goal.get_goal_status().status in _WORKED_ON

    def set_succeeded(self, result: Message | None = None, text: str = "") -> None:
        """Report that the goal is reached."""
        with self.lock:
            self._current().set_succeeded(result or self.get_default_result(), text)

    def set_aborted(self, result: Message | None = None, text: str = "") -> None:
        """Report that the goal cannot be reached."""
        with self.lock:
            self._current().set_aborted(result or self.get_default_result(), text)

    def set_preempted(self, result: Message | None = None, text: str = "") -> None:
        """Report that the goal was preempted on request."""
        with self.lock:
            self._current().set_canceled(result or self.get_default_result(), text)

    def publish_feedback(self, feedback: Message) -> None:
        """Publish feedback."""
        self._current().publish_feedback(feedback)

    def get_default_result(self) -> Any:
        """Return an empty result."""
        return self.action_server.types.result()

    def register_goal_callback(self, cb: Callable[[], Any] | None) -> None:
        """Call a function whenever a goal comes; not together with `execute_cb`."""
        if self.execute_callback is not None:
            _LOG.warning("Cannot call register_goal_callback because an executeCallback exists")
        else:
            self.goal_callback = cb

    def register_preempt_callback(self, cb: Callable[[], Any] | None) -> None:
        """Call a function whenever the work shall end before it is done."""
        self.preempt_callback = cb

    def _current(self) -> ServerGoalHandle:
        if self.current_goal is None:
            status = actionlib_msgs.msg.GoalStatus()
            return ServerGoalHandle(self.action_server, status, None)
        return self.current_goal

    # What comes in -----------------------------------------------------------------------------

    def _on_goal(self, goal: ServerGoalHandle) -> None:
        with self._news:
            newest = [g.get_goal_id().stamp for g in (self.current_goal, self.next_goal) if g]
            if any(goal.get_goal_id().stamp < stamp for stamp in newest):
                goal.set_canceled(None, _NEWER)
                return
            waiting = self.next_goal
            if waiting is not None and waiting is not self.current_goal and self.new_goal:
                waiting.set_canceled(None, _NEWER)
            self.next_goal, self.new_goal = goal, True
            self.new_goal_preempt_request = False
            preempt = self.is_active()
            self.preempt_request = self.preempt_request or preempt
            self._news.notify_all()
        if preempt and self.preempt_callback is not None:
            self.preempt_callback()
        if self.goal_callback is not None:
            self.goal_callback()

    def _on_cancel(self, goal: ServerGoalHandle) -> None:
        with self.lock:
            if goal is self.current_goal:
                self.preempt_request = True
            elif goal is self.next_goal:
                self.new_goal_preempt_request = True
                return
            else:
                return
        if self.preempt_callback is not None:
            self.preempt_callback()

    # The thread --------------------------------------------------------------------------------

    def _execute_goals(self) -> None:
        while not self._terminate and not self.node.closed:
            with self._news:
                if not self.new_goal:
                    self._news.wait(1.0)
                    continue
                waiting = self.next_goal
            if waiting is not None:
                self.action_server.settle(waiting)
            with self._news:
                if self.is_active():
                    _LOG.error("Should never reach this code with an active goal")
                    return
                goal = self.accept_new_goal()
            self._execute(goal)

    def _execute(self, goal: Message) -> None:
        try:
            if self.execute_callback is not None:
                self.execute_callback(goal)
        except Exception as error:  # noqa: BLE001  # reported to the client, the server continues
            if self.node.closed:
                return
            report("Exception in your execute callback", error)
            self.set_aborted(None, f"Exception in execute callback: {error}")
            return
        if self.is_active() and not self.node.closed:
            _LOG.warning("%s", _UNFINISHED)
            self.set_aborted(None, "No terminal state was set.")
