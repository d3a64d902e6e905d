"""Server of this node's transforms, by an action."""

from __future__ import annotations

import threading
import time
from typing import Any

from gazelle_ros.actions.server import ServerGoalHandle
from gazelle_ros.compat.actionlib.action_server import ActionServer
from gazelle_ros.compat.rospy.rostime import get_rostime
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.compat.tf2_py import TransformException
from gazelle_ros.compat.tf2_ros.buffer_client import ERRORS
from gazelle_ros.msgs import tf2_msgs

_NUMBERS: dict[type[Exception], int] = {kind: number for number, kind in ERRORS.items()}


class BufferServer:
    """Answers look-ups of `BufferClient`.

    Args:
        buffer: Buffer of transforms.
        ns: Of the action.
        auto_start: Start at once.
        check_period: Period of the checks of waiting goals [s].
    """

    def __init__(
        self,
        buffer: Any,
        ns: str,
        auto_start: bool = True,  # noqa: FBT001, FBT002  # tf2_ros's interface
        check_period: Any = 0.01,
    ) -> None:
        self.buffer = buffer
        seconds = getattr(check_period, "to_sec", None)
        self._period = float(seconds() if seconds is not None else check_period)
        self._waiting: list[tuple[ServerGoalHandle, Any]] = []
        self._news = threading.Condition()
        self._results = tf2_msgs.msg.LookupTransformResult
        self.server = ActionServer(
            ns,
            tf2_msgs.msg.LookupTransformAction,
            self._take,
            self._give_up,
            auto_start=False,
        )
        self._thread = threading.Thread(target=self._watch, name=f"tf2 {ns}", daemon=True)
        if auto_start:
            self.start()

    def start(self) -> None:
        """Start the server."""
        if not self._thread.is_alive():
            self._thread.start()
        self.server.start()

    def _take(self, handle: ServerGoalHandle) -> None:
        handle.set_accepted("Goal accepted")
        goal = handle.get_goal()
        end = get_rostime() + goal.timeout
        if self._can(goal) or not goal.timeout:
            self._answer(handle)
            return
        with self._news:
            self._waiting.append((handle, end))
            self._news.notify_all()

    def _give_up(self, handle: ServerGoalHandle) -> None:
        with self._news:
            self._waiting = [each for each in self._waiting if each[0] != handle]
        handle.set_canceled(self._results())

    def _watch(self) -> None:
        while not process.shutdown.is_set():
            with self._news:
                if not self._waiting:
                    self._news.wait(1.0)
                    continue
                now = get_rostime()
                ripe = [e for e in self._waiting if now >= e[1] or self._can(e[0].get_goal())]
                self._waiting = [each for each in self._waiting if each not in ripe]
            for handle, _ in ripe:
                self._answer(handle)
            time.sleep(self._period)

    def _can(self, goal: tf2_msgs.msg.LookupTransformGoal) -> bool:
        if goal.advanced:
            found = self.buffer.can_transform_full(
                goal.target_frame,
                goal.target_time,
                goal.source_frame,
                goal.source_time,
                goal.fixed_frame,
            )
        else:
            found = self.buffer.can_transform(
                goal.target_frame, goal.source_frame, goal.source_time
            )
        return bool(found)

    def _answer(self, handle: ServerGoalHandle) -> None:
        goal = handle.get_goal()
        result = self._results()
        try:
            if goal.advanced:
                result.transform = self.buffer.lookup_transform_full(
                    goal.target_frame,
                    goal.target_time,
                    goal.source_frame,
                    goal.source_time,
                    goal.fixed_frame,
                )
            else:
                result.transform = self.buffer.lookup_transform(
                    goal.target_frame, goal.source_frame, goal.source_time
                )
        except TransformException as error:
            result.error.error = _NUMBERS.get(type(error), _NUMBERS[TransformException])
            result.error.error_string = str(error)
        handle.set_succeeded(result)
