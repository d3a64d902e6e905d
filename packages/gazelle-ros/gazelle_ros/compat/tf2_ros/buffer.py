"""A buffer that waits for transforms."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from gazelle_ros.compat.rospy.guest import user
from gazelle_ros.compat.rospy.names import resolve_name
from gazelle_ros.compat.rospy.rostime import Duration, get_rostime
from gazelle_ros.compat.rospy.service import Service
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.compat.tf2_py import BufferCore
from gazelle_ros.compat.tf2_ros.buffer_interface import BufferInterface
from gazelle_ros.errors import RosError
from gazelle_ros.msgs import tf2_msgs

_ZERO = Duration(0)
_LOOK_S = 0.01
DEFAULT_CAN_TRANSFORM_POLLING_SCALE = 0.01
Answer = tuple[bool, str]


class Buffer(BufferCore, BufferInterface):
    """Frames over time, filled by a `TransformListener`.

    Args:
        cache_time: Time to keep transforms, 10 s by default.
        debug: Offer the service ``~tf2_frames``.
    """

    def __init__(self, cache_time: Any = None, debug: bool = True) -> None:  # noqa: FBT001, FBT002  # tf2_ros's interface
        BufferCore.__init__(self, cache_time)
        BufferInterface.__init__(self)
        self._news = threading.Event()
        self.tree.on_change(self._news.set)
        if debug and process.node is not None:
            self._offer_frames()

    def _offer_frames(self) -> None:
        try:
            user().master.lookup_service(resolve_name("~tf2_frames"))
        except RosError:
            kind = tf2_msgs.srv.FrameGraph

            def frames(_request: tf2_msgs.srv.FrameGraphRequest) -> dict[str, str]:
                return {"frame_yaml": self.all_frames_as_yaml()}

            self.frame_server = Service("~tf2_frames", kind, frames)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = _ZERO
    ) -> Any:
        """Return the ``TransformStamped`` from source to target.

        Args:
            target_frame: Frame of the result.
            source_frame: Frame of the values.
            time: Time, 0 for the latest.
            timeout: Longest wait, in the time of the node.

        Raises:
            TransformException: There is none; its class says why.
        """
        self.can_transform(target_frame, source_frame, time, timeout)
        return self.lookup_transform_core(target_frame, source_frame, time)

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

        See `lookup_transform`.
        """
        frames = (target_frame, target_time, source_frame, source_time, fixed_frame)
        self.can_transform_full(*frames, timeout)
        return self.lookup_transform_full_core(*frames)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Any,
        timeout: Any = _ZERO,
        return_debug_tuple: bool = False,  # noqa: FBT001, FBT002  # tf2_ros's interface
    ) -> Any:
        """Return whether there is a transform, at the latest after `timeout`.

        Returns:
            Whether; or with `return_debug_tuple` that, and why not.
        """

        def read() -> Answer:
            return self.can_transform_core(target_frame, source_frame, time)

        answer = self._wait(read, timeout)
        return answer if return_debug_tuple else answer[0]

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = _ZERO,
        return_debug_tuple: bool = False,  # noqa: FBT001, FBT002  # tf2_ros's interface
    ) -> Any:
        """Return whether there is a transform from one time to another; see `can_transform`."""

        def read() -> Answer:
            return self.can_transform_full_core(
                target_frame, target_time, source_frame, source_time, fixed_frame
            )

        answer = self._wait(read, timeout)
        return answer if return_debug_tuple else answer[0]

    def _wait(self, read: Callable[[], Answer], timeout: Any) -> Answer:
        """Call a function again whenever something changed, until the timeout."""
        answer = read()
        if answer[0] or not timeout > _ZERO:
            return answer
        begin = get_rostime()
        while not answer[0] and not process.shutdown.is_set():
            now = get_rostime()
            # When simulated time jumps back, it may never come to the end.
            if now - begin >= timeout or begin - now > Duration(3):
                break
            if self._news.wait(_LOOK_S):
                self._news.clear()
            answer = read()
        return answer
