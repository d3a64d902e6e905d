"""Server of interactive markers: publishes them, and calls functions when people use them."""

from __future__ import annotations

import copy
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from gazelle_ros.compat import rospy
from gazelle_ros.msgs import geometry_msgs, std_msgs, visualization_msgs

InteractiveMarker = visualization_msgs.msg.InteractiveMarker
InteractiveMarkerFeedback = visualization_msgs.msg.InteractiveMarkerFeedback
InteractiveMarkerInit = visualization_msgs.msg.InteractiveMarkerInit
InteractiveMarkerPose = visualization_msgs.msg.InteractiveMarkerPose
InteractiveMarkerUpdate = visualization_msgs.msg.InteractiveMarkerUpdate

__all__ = [
    "InteractiveMarker",
    "InteractiveMarkerFeedback",
    "InteractiveMarkerInit",
    "InteractiveMarkerPose",
    "InteractiveMarkerServer",
    "InteractiveMarkerUpdate",
]

Callback = Callable[[Any], Any]
_ALIVE_S = 0.5
_OTHERS_WAIT_S = 1.0  # while one client moves a marker, others may not
_KEPT = -1


@dataclass
class _Callbacks:
    """Functions for the feedback of one marker."""

    usual: Callback | None = None
    of_kind: dict[int, Callback] = field(default_factory=dict)

    def set(self, function: Callback | None, kind: int) -> None:
        if kind == InteractiveMarkerServer.DEFAULT_FEEDBACK_CB:
            self.usual = function
        elif function is None:
            self.of_kind.pop(kind, None)
        else:
            self.of_kind[kind] = function


@dataclass
class _PublishedMarker:
    """A marker that has been published."""

    marker: Any
    callbacks: _Callbacks
    client: str = ""
    used: Any = None


@dataclass
class _PendingMarker:
    """A change that has not been published; ``marker`` is None for one that is erased."""

    marker: Any
    moved: bool = False
    callbacks: _Callbacks = field(default_factory=_Callbacks)


class InteractiveMarkerServer:
    """Markers below a topic; changes are published by `applyChanges`.

    Args:
        topic_ns: Topics are ``update``, ``update_full`` and ``feedback`` below it.
        server_id: Behind the node's name in what the server is called.
        q_size: Length of the queue of feedback.
    """

    DEFAULT_FEEDBACK_CB = 255

    def __init__(self, topic_ns: str, server_id: str = "", q_size: int = 100) -> None:
        self.server_id = rospy.get_name() + server_id
        self.seq_num = 0
        self._lock = threading.RLock()
        self._shown: dict[str, _PublishedMarker] = {}
        self._pending: dict[str, _PendingMarker] = {}
        self.init_pub = rospy.Publisher(
            f"{topic_ns}/update_full", InteractiveMarkerInit, latch=True, queue_size=100
        )
        self.update_pub = rospy.Publisher(
            f"{topic_ns}/update", InteractiveMarkerUpdate, queue_size=100
        )
        rospy.Subscriber(
            f"{topic_ns}/feedback",
            InteractiveMarkerFeedback,
            self.processFeedback,
            queue_size=q_size,
        )
        rospy.Timer(rospy.Duration(_ALIVE_S), self.keepAlive, reset=True)
        self.publishInit()

    def insert(
        self,
        marker: visualization_msgs.msg.InteractiveMarker,
        feedback_cb: Any = _KEPT,
        feedback_type: int = DEFAULT_FEEDBACK_CB,
    ) -> None:
        """Add a marker, or replace the one of its name.

        Args:
            marker: The marker.
            feedback_cb: Called with feedback of it; without it functions stay as they are.
            feedback_type: For which feedback; see `setCallback`.
        """
        with self._lock:
            pending = self._pending.setdefault(marker.name, _PendingMarker(None))
            pending.marker, pending.moved = marker, False
        if feedback_cb != _KEPT:
            self.setCallback(marker.name, feedback_cb, feedback_type)

    def setPose(  # noqa: N802  # ROS's name
        self, name: str, pose: geometry_msgs.msg.Pose, header: std_msgs.msg.Header | None = None
    ) -> bool:
        """Move a marker; returns whether there is one that has been published."""
        with self._lock:
            shown, pending = self._shown.get(name), self._pending.get(name)
            if shown is None or (pending is not None and pending.marker and not pending.moved):
                return False
            self._move(name, pose, header if header and header.frame_id else shown.marker.header)
        return True

    def _move(
        self, name: str, pose: geometry_msgs.msg.Pose, header: std_msgs.msg.Header | None
    ) -> None:
        pending = self._pending.setdefault(name, _PendingMarker(None, moved=True))
        if pending.marker is None or pending.moved:
            marker = copy.copy(self._shown[name].marker)
            pending.marker, pending.moved = marker, True
        pending.marker.pose, pending.marker.header = pose, header

    def erase(self, name: str) -> bool:
        """Remove a marker; returns whether there is one."""
        with self._lock:
            if name not in self._pending and name not in self._shown:
                return False
            self._pending[name] = _PendingMarker(None)
        return True

    def clear(self) -> None:
        """Remove all markers."""
        with self._lock:
            self._pending = {name: _PendingMarker(None) for name in self._shown}

    def setCallback(  # noqa: N802  # ROS's name
        self, name: str, feedback_cb: Callback | None, feedback_type: int = DEFAULT_FEEDBACK_CB
    ) -> bool:
        """Set what is called with feedback of a marker; returns whether there is one.

        Args:
            name: Of the marker.
            feedback_cb: The function; None for none.
            feedback_type: An event of InteractiveMarkerFeedback, or all that have no function.
        """
        with self._lock:
            found = self._shown.get(name), self._pending.get(name)
            for each in found:
                if each is not None:
                    each.callbacks.set(feedback_cb, feedback_type)
        return any(found)

    def applyChanges(self) -> None:  # noqa: N802  # ROS's name
        """Publish all changes since the last call."""
        with self._lock:
            if not self._pending:
                return
            update = InteractiveMarkerUpdate(type=InteractiveMarkerUpdate.UPDATE)
            for name, pending in self._pending.items():
                self._apply(name, pending, update)
            self._pending = {}
            self.seq_num += 1
            self._publish(update)
            self.publishInit()

    def _apply(self, name: str, pending: _PendingMarker, update: Any) -> None:
        """Apply a change, and add it to a message."""
        shown, marker = self._shown.get(name), pending.marker
        if marker is None:
            if self._shown.pop(name, None) is not None:
                update.erases.append(name)
        elif not pending.moved:
            if shown is None:
                self._shown[name] = _PublishedMarker(marker, pending.callbacks)
            else:
                shown.marker = marker
            update.markers.append(marker)
        elif shown is not None:
            shown.marker = marker
            update.poses.append(InteractiveMarkerPose(marker.header, marker.pose, name))

    def get(self, name: str) -> Any:
        """Return a marker as it will be after `applyChanges`; None if there is none."""
        with self._lock:
            if name in self._pending:
                return self._pending[name].marker
            return self._shown[name].marker if name in self._shown else None

    def getNames(self) -> list[str]:  # noqa: N802  # ROS's name
        """Return the names of all markers that are published."""
        return list(self._shown)

    def processFeedback(self, feedback: visualization_msgs.msg.InteractiveMarkerFeedback) -> None:  # noqa: N802  # ROS's name
        """Move a marker as a user does, and call its functions."""
        with self._lock:
            shown = self._shown.get(feedback.marker_name)
            if shown is None or self._is_anothers(shown, feedback.client_id):
                return
            shown.client, shown.used = feedback.client_id, rospy.get_rostime()
            if feedback.event_type == InteractiveMarkerFeedback.POSE_UPDATE:
                header = shown.marker.header
                fixed = header.stamp == rospy.Time()
                self._move(shown.marker.name, feedback.pose, header if fixed else feedback.header)
            function = shown.callbacks.of_kind.get(feedback.event_type, shown.callbacks.usual)
        if function is not None:
            function(feedback)

    @staticmethod
    def _is_anothers(shown: _PublishedMarker, client: str) -> bool:
        if shown.used is None or shown.client == client:
            return False
        return bool((rospy.get_rostime() - shown.used).to_sec() < _OTHERS_WAIT_S)

    def keepAlive(self, _event: Any = None) -> None:  # noqa: N802  # ROS's name
        """Publish that the server is alive."""
        self._publish(InteractiveMarkerUpdate(type=InteractiveMarkerUpdate.KEEP_ALIVE))

    def _publish(self, update: Any) -> None:
        update.server_id, update.seq_num = self.server_id, self.seq_num
        self.update_pub.publish(update)

    def publishInit(self) -> None:  # noqa: N802  # ROS's name
        """Publish all markers for viewers that come later."""
        with self._lock:
            markers = [shown.marker for shown in self._shown.values()]
            self.init_pub.publish(InteractiveMarkerInit(self.server_id, self.seq_num, markers))
