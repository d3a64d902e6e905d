"""States that wait for messages or for a condition."""

from __future__ import annotations

import threading
from typing import Any

from gazelle_ros.compat import rospy
from gazelle_ros.drop_in.smach import State
from gazelle_ros.drop_in.smach.state import add_interface

_POLL_S = 0.05


class MonitorState(State):
    """Watches a topic; ``invalid`` once a message is, ``valid`` after enough that are not, or ``preempted``.

    Args:
        topic: Of the messages.
        msg_type: Their class.
        cond_cb: Called with userdata and a message; returns whether the message is valid.
        max_checks: So many messages are enough; -1 for no end.
        input_keys: Userdata that is read.
        output_keys: Userdata that is written.
    """

    def __init__(
        self,
        topic: str,
        msg_type: Any,
        cond_cb: Any,
        max_checks: int = -1,
        input_keys: Any = (),
        output_keys: Any = (),
    ) -> None:
        super().__init__(["valid", "invalid", "preempted"], input_keys, output_keys)
        self._topic, self._kind, self._cond_cb = topic, msg_type, cond_cb
        self._most, self._checks = max_checks, 0
        self._ended = threading.Event()

    def execute(self, ud: Any) -> Any:
        """Monitor the topic; returns the outcome."""
        self._checks = 0
        self._ended.clear()
        if not self.preempt_requested():
            subscriber = rospy.Subscriber(self._topic, self._kind, self._check, callback_args=ud)
            while not self._ended.wait(_POLL_S) and not rospy.is_shutdown():
                pass
            subscriber.unregister()
        if self.preempt_requested():
            self.service_preempt()
            return "preempted"
        return "valid" if 0 < self._most <= self._checks else "invalid"

    def _check(self, message: Any, ud: Any) -> None:
        if self._ended.is_set():
            return
        try:
            valid = self._cond_cb(ud, message)
        except Exception as error:  # noqa: BLE001  # smach's outcome for it is 'invalid'
            rospy.logerr(f"the condition on {self._topic} failed: {error!r}")
            valid = False
        self._checks += bool(valid)
        if not valid or 0 < self._most <= self._checks:
            self._ended.set()

    def request_preempt(self) -> None:
        """Request it to end early."""
        super().request_preempt()
        self._ended.set()


class ConditionState(State):
    """Polls a function; ``true`` once that is, ``false`` at the end, or ``preempted``.

    Args:
        cond_cb: Called with userdata.
        input_keys: Userdata that is read.
        poll_rate: Time between two calls; by default 0.05 s.
        timeout: It ends after so long.
        max_checks: It ends after so many more calls; -1 for no end.
    """

    def __init__(
        self,
        cond_cb: Any,
        input_keys: Any = (),
        poll_rate: Any = None,
        timeout: Any = None,
        max_checks: int = 1,
    ) -> None:
        super().__init__(["true", "false", "preempted"], input_keys)
        self._cond_cb = cond_cb
        add_interface(self, cond_cb)
        self._period, self._limit = poll_rate or rospy.Duration(_POLL_S), timeout
        self._most = max_checks

    def execute(self, ud: Any) -> Any:
        """Evaluate the condition; returns the outcome."""
        begun, checks = rospy.get_rostime(), 0
        while not rospy.is_shutdown() and (self._most == -1 or checks <= self._most):
            if self._limit and rospy.get_rostime() - begun > self._limit:
                break
            if self.preempt_requested():
                self.service_preempt()
                return "preempted"
            if self._cond_cb(ud):
                return "true"
            checks += 1
            rospy.sleep(self._period)
        return "false"
