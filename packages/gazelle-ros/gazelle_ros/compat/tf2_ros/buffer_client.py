"""A buffer in another node, reached by an action."""

from __future__ import annotations

from typing import Any

from gazelle_ros.compat.actionlib.simple_action_client import SimpleActionClient
from gazelle_ros.compat.rospy.rostime import Duration, Time
from gazelle_ros.compat.tf2_py import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from gazelle_ros.compat.tf2_ros.buffer_interface import BufferInterface
from gazelle_ros.msgs import tf2_msgs

_ZERO = Duration(0)
_PADDING = Duration(2)
ERRORS = {
    1: LookupException,
    2: ConnectivityException,
    3: ExtrapolationException,
    4: InvalidArgumentException,
    5: TimeoutException,
    6: TransformException,
}
"""Exceptions for the numbers of tf2_msgs/TF2Error."""


class BufferClient(BufferInterface):
    """Asks a buffer server for transforms.

    Args:
        ns: Of the server's action.
        check_frequency: Accepted, and not needed.
        timeout_padding: Time to wait beyond the server's time-out.
    """

    def __init__(
        self, ns: str, check_frequency: float | None = None, timeout_padding: Any = _PADDING
    ) -> None:
        super().__init__()
        del check_frequency
        self.client = SimpleActionClient(ns, tf2_msgs.msg.LookupTransformAction)
        self.timeout_padding = timeout_padding

    def wait_for_server(self, timeout: Any = _ZERO) -> bool:
        """Wait for the server, 0 for ever; whether it is there."""
        return self.client.wait_for_server(timeout)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = _ZERO
    ) -> Any:
        """Return the ``TransformStamped`` from source to target.

        Raises:
            TransformException: There is none; its class says why.
        """
        return self._look_up(
            target_frame=target_frame,
            source_frame=source_frame,
            source_time=time,
            timeout=timeout,
            advanced=False,
        )

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = _ZERO,
    ) -> Any:
        """Return the transform from source at one time to target at another.

        Raises:
            TransformException: There is none; its class says why.
        """
        return self._look_up(
            target_frame=target_frame,
            source_frame=source_frame,
            source_time=source_time,
            timeout=timeout,
            target_time=target_time,
            fixed_frame=fixed_frame,
            advanced=True,
        )

    def can_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = _ZERO
    ) -> bool:
        """Return whether there is a transform."""
        try:
            self.lookup_transform(target_frame, source_frame, time, timeout)
        except TransformException:
            return False
        return True

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = _ZERO,
    ) -> bool:
        """Return whether there is a transform from one time to another."""
        try:
            self.lookup_transform_full(
                target_frame, target_time, source_frame, source_time, fixed_frame, timeout
            )
        except TransformException:
            return False
        return True

    def _look_up(self, **fields: Any) -> Any:
        goal = tf2_msgs.msg.LookupTransformGoal(**fields)
        if not goal.target_time:
            goal.target_time = Time(0)
        self.client.send_goal(goal)
        if not self.client.wait_for_result(goal.timeout + self.timeout_padding):
            self.client.cancel_goal()
            raise TimeoutException("The LookupTransform goal sent to the BufferServer timed out")
        result = self.client.get_result()
        if result is None:
            raise TransformException("The BufferServer gave up on the LookupTransform goal")
        if result.error.error:
            kind = ERRORS.get(result.error.error, TransformException)
            raise kind(result.error.error_string)
        return result.transform
