"""Poses of AGVs: from a topic, or from a service that is polled."""

from __future__ import annotations

import math
import threading
from abc import ABC, abstractmethod
from collections.abc import Sequence
from functools import partial

import numpy as np

from gazelle.array_types import Floats
from gazelle.clients.errors import ClientError
from gazelle.errors import did_you_mean
from gazelle_ros import Node, load_service
from gazelle_ros.clock import SECOND
from gazelle_ros.errors import RosError
from gazelle_ros.msgs import nav_msgs


class PoseSource(ABC):
    """The poses of some robots, as news come.

    Args:
        count: Number of robots.
        name: Of the topics or services.

    Attributes:
        count: Of news so far.
    """

    def __init__(self, count: int, name: str) -> None:
        self.name, self.count = name, 0
        self._poses = np.full((count, 3), math.nan)
        self._time = 0.0
        self._news = threading.Condition()
        self._seen = 0

    @property
    def known(self) -> bool:
        """True if all poses are known."""
        return not np.isnan(self._poses).any()

    def latest(self) -> tuple[Floats, float]:
        """Return x, y [m] and heading [rad], shape (count, 3), and their time [s]."""
        with self._news:
            return self._poses.copy(), self._time

    def await_news(self, timeout: float) -> bool:
        """Wait for poses newer than at the last call [s of wall time]; whether all are known."""
        with self._news:
            self._news.wait_for(lambda: self.count != self._seen, timeout)
            fresh = self.count != self._seen
            self._seen = self.count
        return fresh and self.known

    @abstractmethod
    def close(self) -> None:
        """Stop requests and subscriptions."""


class TopicPoses(PoseSource):
    """Poses from ``nav_msgs/Odometry``; time is that of its stamps."""

    def __init__(self, node: Node, spaces: Sequence[str], name: str) -> None:
        super().__init__(len(spaces), name)
        self._stamps = np.zeros(len(spaces))
        kind = nav_msgs.msg.Odometry
        self._subscribers = [
            node.subscribe(f"{space}/{name}", kind, partial(self._receive, index), 1)
            for index, space in enumerate(spaces)
        ]

    def _receive(self, index: int, message: nav_msgs.msg.Odometry) -> None:
        place, turned = message.pose.pose.position, message.pose.pose.orientation
        heading = math.atan2(
            2.0 * (turned.w * turned.z + turned.x * turned.y),
            1.0 - 2.0 * (turned.y * turned.y + turned.z * turned.z),
        )
        with self._news:
            self._poses[index] = place.x, place.y, heading
            self._stamps[index] = message.header.stamp.to_sec()
            # News are complete when the slowest robot has published its pose at this time.
            oldest = float(self._stamps.min())
            if oldest != self._time or len(self._stamps) == 1:
                self._time = oldest
                self.count += 1
                self._news.notify_all()

    def close(self) -> None:
        """Unsubscribe."""
        for subscriber in self._subscribers:
            subscriber.close()


class ServicePoses(PoseSource):
    """Poses from a service without request that answers x, y and an angle in degrees."""

    def __init__(
        self, node: Node, spaces: Sequence[str], name: str, kind: str, rate: float
    ) -> None:
        super().__init__(len(spaces), name)
        service = load_service(kind)
        self._node, self._period = node, round(SECOND / rate)
        self._request = service._request_class()
        self._clients = [
            node.client(f"{space}/{name}", service, persistent=True) for space in spaces
        ]
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._poll, name="agv-poses", daemon=True)
        self._thread.start()

    def _poll(self) -> None:
        while not self._stop.is_set():
            try:
                answers = [client.call(self._request, timeout=10.0) for client in self._clients]
            except RosError:
                self._stop.wait(0.05)
                continue
            poses = [(each.x, each.y, math.radians(each.angle)) for each in answers]
            with self._news:
                self._poses[:] = poses
                self._time = self._node.clock.now() / SECOND
                self.count += 1
                self._news.notify_all()
            self._node.clock.sleep(self._period, self._stop.is_set)

    def close(self) -> None:
        """Stop requests."""
        self._stop.set()
        self._thread.join(timeout=15.0)
        for client in self._clients:
            client.close()


def pose_source(
    poses: str, node: Node, spaces: Sequence[str], name: str | None, kind: str, rate: float
) -> PoseSource:
    """Return the source that is asked for.

    Raises:
        ClientError: There is no such source.
        UnknownTypeError: The type of the service is not known.
    """
    if poses == "topic":
        return TopicPoses(node, spaces, name or "base_pose_ground_truth")
    if poses == "service":
        return ServicePoses(node, spaces, name or "get_pose", kind, rate)
    raise ClientError(
        f"poses come from a topic or a service, not from '{poses}'",
        hint=did_you_mean(poses, ("topic", "service")),
    )
