"""The core of tf2: frames and look-ups, with messages for values."""

from __future__ import annotations

from typing import Any

from gazelle_ros.clock import SECOND
from gazelle_ros.compat.rospy.rostime import Time
from gazelle_ros.msgs import geometry_msgs
from gazelle_ros.tf.core import DEFAULT_CACHE_NS, FrameTree, StampedTransform
from gazelle_ros.tf.describe import as_dot, as_yaml
from gazelle_ros.tf.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)

__all__ = [
    "BufferCore",
    "ConnectivityException",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "TimeoutException",
    "TransformException",
]


class BufferCore:
    """Frames over time.

    Args:
        cache_time: Time to keep transforms, 10 s by default.
    """

    def __init__(self, cache_time: Any = None) -> None:
        self.tree = FrameTree(DEFAULT_CACHE_NS if cache_time is None else nanoseconds(cache_time))
        self._make = geometry_msgs.msg.TransformStamped

    def set_transform(
        self, transform: geometry_msgs.msg.TransformStamped, authority: str = ""
    ) -> None:
        """Add a ``TransformStamped``; an invalid one is logged and left out."""
        self._set(transform, authority, static=False)

    def set_transform_static(
        self, transform: geometry_msgs.msg.TransformStamped, authority: str = ""
    ) -> None:
        """Add a ``TransformStamped`` that holds at all times."""
        self._set(transform, authority, static=True)

    def _set(
        self, transform: geometry_msgs.msg.TransformStamped, authority: str, *, static: bool
    ) -> None:
        header, value = transform.header, transform.transform
        place, turn, stamp = value.translation, value.rotation, header.stamp
        self.tree.place(
            header.frame_id,
            transform.child_frame_id,
            stamp.secs * SECOND + stamp.nsecs,
            (place.x, place.y, place.z),
            (turn.x, turn.y, turn.z, turn.w),
            authority=authority,
            static=static,
        )

    def lookup_transform_core(self, target_frame: str, source_frame: str, time: Any) -> Any:
        """Return the ``TransformStamped`` from source to target at a time, 0 for the latest.

        Raises:
            TransformException: There is none; its class says why.
        """
        _strings(target_frame, source_frame)
        found = self.tree.lookup(target_frame, source_frame, nanoseconds(time))
        return self._message(found, target_frame, source_frame)

    def lookup_transform_full_core(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> Any:
        """Return the transform from source at one time to target at another.

        Raises:
            TransformException: There is none; its class says why.
        """
        _strings(target_frame, source_frame, fixed_frame)
        found = self.tree.lookup_full(
            target_frame,
            nanoseconds(target_time),
            source_frame,
            nanoseconds(source_time),
            fixed_frame,
        )
        return self._message(found, target_frame, source_frame)

    def _message(self, found: StampedTransform, target: str, source: str) -> Any:
        result = self._make()
        result.header.stamp = Time(nsecs=found.stamp)
        result.header.frame_id, result.child_frame_id = target, source
        place, turn = result.transform.translation, result.transform.rotation
        place.x, place.y, place.z = found.translation
        turn.x, turn.y, turn.z, turn.w = found.rotation
        return result

    def can_transform_core(
        self, target_frame: str, source_frame: str, time: Any
    ) -> tuple[bool, str]:
        """Return whether a look-up would succeed, and the reason if not."""
        _strings(target_frame, source_frame)
        stamp = nanoseconds(time)
        if target_frame == source_frame:
            return True, ""
        missing = self._missing({"target_frame": target_frame, "source_frame": source_frame})
        if missing is not None:
            return False, missing
        try:
            self.tree.lookup(target_frame, source_frame, stamp)
        except TransformException as error:
            return False, error.message
        return True, ""

    def can_transform_full_core(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> tuple[bool, str]:
        """Return whether a look-up over a fixed frame would succeed, and the reason if not."""
        frames = {
            "target_frame": target_frame,
            "source_frame": source_frame,
            "fixed_frame": fixed_frame,
        }
        _strings(*frames.values())
        missing = self._missing(frames)
        if missing is not None:
            return False, missing
        try:
            self.lookup_transform_full_core(
                target_frame, target_time, source_frame, source_time, fixed_frame
            )
        except TransformException as error:
            return False, error.message
        return True, ""

    def _missing(self, frames: dict[str, str]) -> str | None:
        """Return the error in frames' names: None if valid, empty for those tf2 only logs."""
        if any(not name or name.startswith("/") for name in frames.values()):
            return ""
        unknown = [
            f"{what} {name} does not exist."
            for what, name in frames.items()
            if not self.tree.has(name)
        ]
        return "canTransform: " + " ".join(unknown) if unknown else None

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Time:
        """Return the latest time at which both frames are known.

        Raises:
            TransformException: There is none; its class says why.
        """
        stamp = self.tree.latest_common_time(target_frame, source_frame)
        return Time(nsecs=stamp)

    def clear(self) -> None:
        """Discard all transforms but static ones."""
        self.tree.clear()

    def all_frames_as_yaml(self) -> str:
        """Return parent, broadcaster and times of each frame, as YAML."""
        return as_yaml(self.tree)

    def all_frames_as_string(self) -> str:
        """Return one line for each frame and its parent."""
        return self.tree.as_string()

    # The names of the real module, for scripts that use them.

    def _frameExists(self, frame_id: str) -> bool:  # noqa: N802
        return self.tree.has(frame_id)

    def _getFrameStrings(self) -> list[str]:  # noqa: N802
        return self.tree.names()

    def _allFramesAsDot(self, current_time: Any = None) -> str:  # noqa: N802
        return as_dot(self.tree, None if current_time is None else nanoseconds(current_time))

    def _chain(
        self, target: str, target_time: Any, source: str, source_time: Any, fixed: str
    ) -> list[str]:
        return self.tree.chain(
            target, nanoseconds(target_time), source, nanoseconds(source_time), fixed
        )


def nanoseconds(moment: Any) -> int:
    """Return a time or duration [ns].

    Raises:
        TypeError: It is neither.
    """
    if hasattr(moment, "to_nsec"):
        return int(moment.to_nsec())
    raise TypeError("time must have a to_sec method, e.g. rospy.Time or rospy.Duration")


def _strings(*values: Any) -> None:
    for place, value in enumerate(values, start=1):
        if not isinstance(value, str):
            raise TypeError(f"argument {place} must be str, not {type(value).__name__}")
