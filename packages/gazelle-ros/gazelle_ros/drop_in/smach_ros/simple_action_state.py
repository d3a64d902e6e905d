"""State that sends a goal to an action and waits for its result."""

from __future__ import annotations

import copy
import threading
from typing import Any

from gazelle_ros.compat import rospy
from gazelle_ros.compat.actionlib import GoalStatus, SimpleActionClient
from gazelle_ros.drop_in.smach import InvalidStateError, State
from gazelle_ros.drop_in.smach_ros.callbacks import UserCallback, filled, taken_apart
from gazelle_ros.messages import Message

_SERVER_S = 60.0
_LOOK_S = 0.1


class SimpleActionState(State):
    """Goal of an action; outcomes are ``succeeded``, ``aborted``, ``preempted`` and those of ``result_cb``.

    Args:
        action_name: Of the action.
        action_spec: The message class of the action.
        goal: The goal; without it an empty one.
        goal_key: Userdata with the goal.
        goal_slots: Fields of the goal that are userdata of the same names.
        goal_cb: Called with userdata and the goal; returns the goal, or changes it.
        goal_cb_args: For it.
        goal_cb_kwargs: For it.
        result_key: Userdata for the result.
        result_slots: Fields of the result that become userdata.
        result_cb: Called with userdata, status and result; returns an outcome, or None.
        result_cb_args: For it.
        result_cb_kwargs: For it.
        input_keys: More userdata that is read.
        output_keys: More userdata that is written.
        outcomes: More outcomes.
        exec_timeout: The goal is cancelled after so long.
        preempt_timeout: Taken; a goal that is cancelled is waited for.
        server_wait_timeout: So long it waits for the action's server; by default a minute.

    Raises:
        InvalidStateError: Goal or result have no such fields, or a callback is no function.
    """

    def __init__(  # smach's interface
        self,
        action_name: str,
        action_spec: Any,
        goal: Any = None,
        goal_key: str | None = None,
        goal_slots: Any = (),
        goal_cb: Any = None,
        goal_cb_args: Any = (),
        goal_cb_kwargs: Any = None,
        result_key: str | None = None,
        result_slots: Any = (),
        result_cb: Any = None,
        result_cb_args: Any = (),
        result_cb_kwargs: Any = None,
        input_keys: Any = (),
        output_keys: Any = (),
        outcomes: Any = (),
        exec_timeout: Any = None,
        preempt_timeout: Any = None,
        server_wait_timeout: Any = None,
    ) -> None:
        super().__init__(["succeeded", "aborted", "preempted", *outcomes], input_keys, output_keys)
        del preempt_timeout
        spec = action_spec()
        _check_slots(spec.action_goal.goal, goal_slots)
        _check_slots(spec.action_result.result, result_slots)
        self._name = action_name
        self._goal = spec.action_goal.goal if goal is None else goal
        self._goal_from, self._result_to = (goal_key, goal_slots), (result_key, result_slots)
        self.register_input_keys([*goal_slots, *([goal_key] if goal_key else [])])
        self.register_output_keys([*result_slots, *([result_key] if result_key else [])])
        self._goal_cb = UserCallback(goal_cb, goal_cb_args, goal_cb_kwargs or {})
        self._result_cb = UserCallback(result_cb, result_cb_args, result_cb_kwargs or {})
        for each in (self._goal_cb, self._result_cb):
            each.add_to(self, input_keys, output_keys)
        self._limit = exec_timeout
        self._patience = server_wait_timeout or rospy.Duration(_SERVER_S)
        self._client = SimpleActionClient(action_name, action_spec)
        self._running = False

    def execute(self, ud: Any) -> Any:
        """Send the goal, wait for the result; returns the outcome."""
        if not self._has_server():
            return self._ended_early() or "aborted"
        try:
            goal = filled(copy.copy(self._goal), ud, *self._goal_from)
            made = self._goal_cb(ud, goal)
        except Exception as error:  # noqa: BLE001  # smach's outcome for it is 'aborted'
            rospy.logerr(f"the goal of '{self._name}' cannot be made: {error!r}")
            return "aborted"
        status, result = self._done(goal if made is None else made)
        try:
            outcome = self._result_cb(ud, status, result)
        except Exception as error:  # noqa: BLE001  # the same
            rospy.logerr(f"the result of '{self._name}' cannot be used: {error!r}")
            return "aborted"
        taken_apart(result, ud, *self._result_to)
        if outcome is not None:
            return outcome
        if status == GoalStatus.SUCCEEDED:
            return "succeeded"
        early = self._ended_early() if status == GoalStatus.PREEMPTED else None
        return early or "aborted"

    def _has_server(self) -> bool:
        """Wait for the action's server; returns whether it is there and a goal is still wanted."""
        begun = rospy.get_rostime()
        while not rospy.is_shutdown() and not self.preempt_requested():
            if self._client.wait_for_server(rospy.Duration(1.0)):
                return not self.preempt_requested()
            if rospy.get_rostime() - begun >= self._patience:
                rospy.logerr(f"there is no server of the action '{self._name}'")
                return False
            rospy.logwarn(f"still waiting for the server of the action '{self._name}'")
        return False

    def _done(self, goal: Any) -> tuple[int, Any]:
        """Send a goal and wait; returns its last status, and the result."""
        ended = threading.Event()
        found: list[tuple[int, Any]] = []

        def note(status: int, result: Any) -> None:
            found.append((status, result))
            ended.set()

        begun = rospy.get_rostime()
        self._client.send_goal(goal, done_cb=note)
        self._running = True
        if self.preempt_requested():  # meanwhile
            self._client.cancel_goal()
        cancelled = False
        while not ended.wait(_LOOK_S) and not rospy.is_shutdown():
            late = self._limit and rospy.get_rostime() - begun > self._limit
            if late and not cancelled:
                rospy.logwarn(f"the goal of '{self._name}' takes too long and is cancelled")
                self._client.cancel_goal()
                cancelled = True
        self._running = False
        return found[0] if found else (GoalStatus.LOST, None)

    def _ended_early(self) -> str | None:
        if not self.preempt_requested():
            return None
        self.service_preempt()
        return "preempted"

    def request_preempt(self) -> None:
        """Cancel the goal."""
        super().request_preempt()
        if self._running:
            self._client.cancel_goal()


def _check_slots(message: Message, slots: Any) -> None:
    unknown = [slot for slot in slots if slot not in message.__slots__]
    if unknown:
        raise InvalidStateError(f"there are no fields {unknown}; there are {message.__slots__}")
