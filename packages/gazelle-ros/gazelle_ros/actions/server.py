"""Server of an action: it accepts goals, and publishes their status, feedback and results."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle_ros.actions.spec import ActionTypes, Now, goal_id, header, now
from gazelle_ros.actions.states import FINAL, GoalStatus
from gazelle_ros.errors import NodeClosedError
from gazelle_ros.messages import Message
from gazelle_ros.msgs import actionlib_msgs
from gazelle_ros.publishing import Publisher
from gazelle_ros.time import Duration, Time

if TYPE_CHECKING:
    from gazelle_ros.node import Node

_LOG = logging.getLogger("gazelle.ros.actions")
_QUEUE = 50
_PEER_S = 0.005
"""Time for remote clients to note a goal they sent, or feedback, before the next message.

A rospy client drops what comes for a goal before its ``send_goal`` has returned, and feedback that comes
after the result, as each has a connection of its own. Real servers are slower than this anyway.
"""
_CANCELLED_BEFORE = (
    "This goal handle was canceled by the action server because its timestamp is before the "
    "timestamp of the last cancel request"
)
_WRONG_STATE = (
    "To transition to %s state, the goal must be in a %s state, it is currently in state: %d"
)


class ServerGoalHandle:
    """A goal, for the server that works on it; one made of nothing stands for no goal.

    Attributes:
        status: The ``GoalStatus`` message.
        goal: The goal with its header and id; None if only a cancel request came.
    """

    def __init__(
        self,
        server: ActionServer | None = None,
        status: actionlib_msgs.msg.GoalStatus | None = None,
        goal: Any = None,
    ) -> None:
        self._server = server
        self.status = actionlib_msgs.msg.GoalStatus() if status is None else status
        self.goal = goal
        self.finished = 0
        """When it ended [ns]; 0 before."""
        self.reported_at = time.monotonic()
        """When it came, or the last feedback was sent, on the monotonic clock."""

    def get_goal(self) -> Any:
        """Return the goal; None if only a cancel request came."""
        return None if self.goal is None else self.goal.goal

    def get_goal_id(self) -> actionlib_msgs.msg.GoalID:
        """Return the ``GoalID``."""
        return self.status.goal_id

    def get_goal_status(self) -> actionlib_msgs.msg.GoalStatus:
        """Return the ``GoalStatus``."""
        return self.status

    def get_default_result(self) -> Any:
        """Return an empty result."""
        return None if self._server is None else self._server.types.result()

    def set_accepted(self, text: str = "") -> bool:
        """Accept the goal; False if it cannot be accepted."""
        table = {
            GoalStatus.PENDING: GoalStatus.ACTIVE,
            GoalStatus.RECALLING: GoalStatus.PREEMPTING,
        }
        return self._move("an active", "pending or recalling", table, text)

    def set_canceled(self, result: Message | None = None, text: str = "") -> bool:
        """Report that it was cancelled on request; False if it is invalid."""
        table = {
            GoalStatus.PENDING: GoalStatus.RECALLED,
            GoalStatus.RECALLING: GoalStatus.RECALLED,
            GoalStatus.ACTIVE: GoalStatus.PREEMPTED,
            GoalStatus.PREEMPTING: GoalStatus.PREEMPTED,
        }
        words = "pending, recalling, active, or preempting"
        return self._move("a cancelled", words, table, text, result)

    def set_rejected(self, result: Message | None = None, text: str = "") -> bool:
        """Reject the goal; False if it was accepted."""
        table = dict.fromkeys((GoalStatus.PENDING, GoalStatus.RECALLING), GoalStatus.REJECTED)
        return self._move("a rejected", "pending or recalling", table, text, result)

    def set_aborted(self, result: Message | None = None, text: str = "") -> bool:
        """Report that it failed; False if it was not accepted."""
        table = dict.fromkeys((GoalStatus.ACTIVE, GoalStatus.PREEMPTING), GoalStatus.ABORTED)
        return self._move("an aborted", "preempting or active", table, text, result)

    def set_succeeded(self, result: Message | None = None, text: str = "") -> bool:
        """Report success; False if it was not accepted."""
        table = dict.fromkeys((GoalStatus.ACTIVE, GoalStatus.PREEMPTING), GoalStatus.SUCCEEDED)
        return self._move("a succeeded", "preempting or active", table, text, result)

    def set_cancel_requested(self) -> bool:
        """Handle a cancel request; False if the goal is already terminal."""
        table = {
            GoalStatus.PENDING: GoalStatus.RECALLING,
            GoalStatus.ACTIVE: GoalStatus.PREEMPTING,
        }
        if self._server is None:
            return self._refuse()
        with self._server.lock:
            after = table.get(self.status.status)
            if after is None:
                return False
            self.status.status = after
            self._server.publish_status()
            return True

    def publish_feedback(self, feedback: Message) -> None:
        """Publish feedback."""
        if self._server is None:
            self._refuse()
        else:
            self._server.publish_feedback(self.status, feedback)
            self.reported_at = time.monotonic()

    @staticmethod
    def _refuse() -> bool:
        _LOG.error("Attempt to set status on an uninitialized ServerGoalHandle")
        return False

    def _move(
        self,
        name: str,
        words: str,
        table: dict[int, int],
        text: str,
        result: Message | None = None,
    ) -> bool:
        if self._server is None:
            return self._refuse()
        if self.status.status in table:
            self._server.settle(self)
        with self._server.lock:
            before = self.status.status
            after = table.get(before)
            if after is None:
                _LOG.error(_WRONG_STATE, name, words, before)
                return False
            self.status.status, self.status.text = after, text
            if after in FINAL:
                self.finished = max(1, self._server.clock.now())
                given = self._server.types.result() if result is None else result
                self._server.publish_result(self.status, given)
            else:
                self._server.publish_status()
            return True

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ServerGoalHandle):
            return NotImplemented
        return bool(self.status.goal_id.id == other.status.goal_id.id)

    def __hash__(self) -> int:
        return hash(self.status.goal_id.id)


GoalCallback = Callable[[ServerGoalHandle], Any]


class ActionServer:
    """Takes goals and cancel requests.

    The parameters ``NAME/status_frequency`` (5 Hz) and ``NAME/status_list_timeout`` (5 s) say how
    often the goals are listed, and how long ended ones stay in the list.

    Args:
        node: Node of the server.
        name: Of the action; topics are below it.
        spec: The message class of the action.
        goal_cb: Called with each new goal.
        cancel_cb: Called with each goal to be cancelled.
        auto_start: Start at once.
        clock: Source of the time, if not the node's; rates of topics are those of the wall's clock.

    Attributes:
        clock: Source of the time.
        status_list: The goals it speaks of, oldest first.

    Raises:
        ActionException: `spec` is no action.
    """

    def __init__(
        self,
        node: Node,
        name: str,
        spec: type[Message],
        goal_cb: GoalCallback | None = None,
        cancel_cb: GoalCallback | None = None,
        *,
        auto_start: bool = True,
        clock: Now | None = None,
    ) -> None:
        self.node = node
        self.clock: Now = clock or node.clock
        self.ns = name
        self.types = ActionTypes.of(spec)
        self.goal_callback = goal_cb
        self.cancel_callback = cancel_cb
        self.lock = threading.RLock()
        self.started = False
        self.status_list: list[ServerGoalHandle] = []
        self._last_cancel = Time(0)
        self._due = time.monotonic()
        self._open()
        if auto_start:
            self.start()

    def _open(self) -> None:
        node, name = self.node, self.ns
        size = int(node.get_param("actionlib_server_pub_queue_size", _QUEUE)) or None
        self._goal_status = actionlib_msgs.msg.GoalStatus
        self._status_array = actionlib_msgs.msg.GoalStatusArray
        self.status_frequency = float(node.get_param(f"{name}/status_frequency", 5.0))
        timeout = float(node.get_param(f"{name}/status_list_timeout", 5.0))
        self.status_list_timeout = Duration.from_sec(timeout)
        self._status = node.advertise(f"{name}/status", self._status_array, size)
        self._result = node.advertise(f"{name}/result", self.types.action_result, size)
        self._feedback = node.advertise(f"{name}/feedback", self.types.action_feedback, size)
        cancel = actionlib_msgs.msg.GoalID
        # Clients wait for a first status; this way they need not wait for the next turn.
        self._status.on_connect = self._greet
        self._subscribers = [
            node.subscribe(f"{name}/goal", self.types.action_goal, self._take_goal),
            node.subscribe(f"{name}/cancel", cancel, self._take_cancel),
        ]

    def register_goal_callback(self, cb: GoalCallback | None) -> None:
        """Call another function with each new goal."""
        self.goal_callback = cb

    def register_cancel_callback(self, cancel_cb: GoalCallback | None) -> None:
        """Call another function with each goal to be given up."""
        self.cancel_callback = cancel_cb

    def start(self) -> None:
        """Start to accept goals."""
        with self.lock:
            if self.started:
                return
            self.started = True
        self._tick()

    def refuse(self) -> None:
        """Reject and list no more goals, as another server may do so now.

        Results are still sent.
        """
        self.started = False
        for subscriber in self._subscribers:
            subscriber.close()

    def stop(self) -> None:
        """Stop accepting goals, and close the topics."""
        for publisher in (self._status, self._result, self._feedback):
            publisher.close()
        self.refuse()

    def _tick(self) -> None:
        if not self.started or self.node.closed:
            return
        if self.status_frequency > 0:
            self._due = max(self._due + 1.0 / self.status_frequency, time.monotonic())
            wait = self._due - time.monotonic()
            self.node.loop.call_later(wait, lambda: self.node.loop.submit(self._tick))
        self.publish_status()

    def settle(self, goal: ServerGoalHandle) -> None:
        """Wait until clients in other processes had time for earlier messages; see `_PEER_S`."""
        publication = self.node.publication(self._status.name)
        left = goal.reported_at + _PEER_S - time.monotonic()
        if left > 0 and publication is not None and publication.remote:
            time.sleep(left)

    def _greet(self, _peer: str) -> None:
        self.publish_status()

    # What goes out -----------------------------------------------------------------------------

    def publish_status(self) -> None:
        """List the goals."""
        with self.lock:
            if not self.started:
                return
            self._forget_old()
            message = self._status_array()
            message.header = header(self.clock)
            message.status_list = [handle.status for handle in self.status_list]
            self._send(self._status, message)

    def publish_result(self, status: actionlib_msgs.msg.GoalStatus, result: Message | None) -> None:
        """Publish the result of a goal."""
        with self.lock:
            message = self.types.action_result(
                header=header(self.clock), status=status, result=result
            )
            self._send(self._result, message)
            self.publish_status()

    def publish_feedback(self, status: actionlib_msgs.msg.GoalStatus, feedback: Message) -> None:
        """Publish feedback on a goal."""
        with self.lock:
            message = self.types.action_feedback(
                header=header(self.clock), status=status, feedback=feedback
            )
            self._send(self._feedback, message)

    def _send(self, publisher: Publisher, message: Message) -> None:
        try:
            publisher.publish(message)
        except NodeClosedError:
            self.started = False

    def _forget_old(self) -> None:
        limit = self.clock.now() - self.status_list_timeout.to_nsec()
        self.status_list = [h for h in self.status_list if not h.finished or h.finished > limit]

    # What comes in -----------------------------------------------------------------------------

    def _find(self, name: str) -> ServerGoalHandle | None:
        return next((h for h in self.status_list if h.status.goal_id.id == name), None)

    def _take_goal(self, goal: Any) -> None:
        with self.lock:
            if not self.started:
                return
            known = self._find(goal.goal_id.id) if goal.goal_id.id else None
            if known is not None:
                self._take_again(known)
                return
            status = self._goal_status()
            status.goal_id = goal.goal_id
            if not status.goal_id.id:
                status.goal_id = goal_id(self.node, clock=self.clock)
            stamped = bool(goal.goal_id.stamp)
            if not stamped:
                status.goal_id.stamp = now(self.clock)
            handle = ServerGoalHandle(self, status, goal)
            self.status_list.append(handle)
            if stamped and goal.goal_id.stamp <= self._last_cancel:
                handle.set_canceled(None, _CANCELLED_BEFORE)
                return
        if self.goal_callback is not None:
            self.goal_callback(handle)

    def _take_again(self, handle: ServerGoalHandle) -> None:
        """Handle a goal whose cancel request came first, or that was sent twice."""
        if handle.status.status == GoalStatus.RECALLING:
            handle.status.status = GoalStatus.RECALLED
            self.publish_result(handle.status, self.types.result())
        if handle.status.status in FINAL:
            handle.finished = max(1, self.clock.now())

    def _take_cancel(self, request: actionlib_msgs.msg.GoalID) -> None:
        with self.lock:
            if not self.started:
                return
            everything = not request.id and not request.stamp
            chosen = [
                handle
                for handle in self.status_list
                if everything
                or handle.status.goal_id.id == request.id
                or (request.stamp and handle.status.goal_id.stamp <= request.stamp)
            ]
            if request.id and self._find(request.id) is None:
                self._remember_cancel(request)
            self._last_cancel = max(self._last_cancel, request.stamp)
            handles = [handle for handle in chosen if handle.set_cancel_requested()]
        for handle in handles:
            if self.cancel_callback is not None:
                self.cancel_callback(handle)

    def _remember_cancel(self, request: actionlib_msgs.msg.GoalID) -> None:
        """Store a cancel request, as its goal may come later."""
        status = self._goal_status()
        status.goal_id, status.status = request, GoalStatus.RECALLING
        handle = ServerGoalHandle(self, status, None)
        handle.finished = max(1, self.clock.now())
        self.status_list.append(handle)
