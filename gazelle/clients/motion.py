"""Drive a model by velocity commands and watch where it goes."""

from __future__ import annotations

import math
import threading
from typing import Any, Self

from gazelle.clients.errors import ClientError
from gazelle.clients.poses import ModelState, read_state, twist_message
from gazelle.closing import Closeable
from gazelle.ros import Node, load_message

_ZERO = (0.0, 0.0, 0.0)
_UNKNOWN = (math.nan, math.nan, math.nan)


class Driver(Closeable):
    """Commands one base and knows its pose; also a context manager, which stops it at the end.

    Args:
        node: Publishes and subscribes.
        model: Its topics are ``/<model>/cmd_vel`` and ``/<model>/pose`` of ``geometry_msgs/Pose``, those
            of the example plugin, unless they are given; velocities are not known then (nan).
        command_topic: Of ``geometry_msgs/Twist``.
        pose_topic: Of ``nav_msgs/Odometry``.
        linear: Speed of ``forward`` and the like [m/s].
        angular: Of turning [rad/s].
    """

    def __init__(
        self,
        node: Node,
        model: str = "",
        *,
        command_topic: str | None = None,
        pose_topic: str | None = None,
        linear: float = 0.2,
        angular: float = 0.5,
    ) -> None:
        space = f"/{model}" if model else ""
        self._linear, self._angular = linear, angular
        self._pose_topic = pose_topic or f"{space}/pose"
        self._state: ModelState | None = None
        self._arrived = threading.Event()
        self._publisher = node.advertise(
            command_topic or f"{space}/cmd_vel", load_message("geometry_msgs/Twist"), 1
        )
        kind, take = ("nav_msgs/Odometry", self._receive)
        if pose_topic is None:
            kind, take = ("geometry_msgs/Pose", self._receive_pose)
        self._subscriber = node.subscribe(self._pose_topic, load_message(kind), take, 1)

    @property
    def state(self) -> ModelState:
        """Pose and velocity of the base, as last received.

        Raises:
            ClientError: No odometry was received yet; see ``wait``.
        """
        if self._state is None:
            raise ClientError(f"nothing came on {self._pose_topic} yet", hint="call wait() first")
        return self._state

    def wait(self, timeout: float = 10.0) -> Self:
        """Wait until the base has subscribed and its pose is known.

        Raises:
            ClientError: That takes longer than ``timeout`` [s of wall time].
        """
        if not self._arrived.wait(timeout):
            raise ClientError(f"nothing comes on {self._pose_topic} within {timeout:g} s")
        return self

    def drive(self, linear: float = 0.0, angular: float = 0.0, sideways: float = 0.0) -> None:
        """Command a velocity [m/s, rad/s]; it holds until the next."""
        self._publisher.publish(twist_message((linear, sideways, 0.0), (0.0, 0.0, angular)))

    def forward(self) -> None:
        """Drive forward."""
        self.drive(self._linear)

    def back(self) -> None:
        """Drive backward."""
        self.drive(-self._linear)

    def left(self) -> None:
        """Turn left."""
        self.drive(angular=self._angular)

    def right(self) -> None:
        """Turn right."""
        self.drive(angular=-self._angular)

    def stop(self) -> None:
        """Stop."""
        self.drive()

    def close(self) -> None:
        """Stop and leave the topics."""
        self.stop()
        self._publisher.close()
        self._subscriber.close()

    def _receive_pose(self, message: Any) -> None:
        place = read_state(message, twist_message(_ZERO, _ZERO))
        self._state = ModelState(place.position, place.quaternion, _UNKNOWN, _UNKNOWN)
        self._arrived.set()

    def _receive(self, message: Any) -> None:
        self._state = read_state(message.pose.pose, message.twist.twist)
        self._arrived.set()
