"""Drive a model by velocity commands and watch where it goes."""

from __future__ import annotations

import math
import threading
from typing import Self

from gazelle.argument_checks import checked
from gazelle.clients.errors import ClientError
from gazelle.clients.poses import ModelState, read_state, twist_message
from gazelle_ros import Node
from gazelle_ros.base.closing import Closeable
from gazelle_ros.msgs import geometry_msgs, nav_msgs

_ZERO = (0.0, 0.0, 0.0)
_UNKNOWN = (math.nan, math.nan, math.nan)


@checked(ClientError)
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
            command_topic or f"{space}/cmd_vel", geometry_msgs.msg.Twist, 1
        )
        self._subscriber = (
            node.subscribe(self._pose_topic, geometry_msgs.msg.Pose, self._receive_pose, 1)
            if pose_topic is None
            else node.subscribe(self._pose_topic, nav_msgs.msg.Odometry, self._receive, 1)
        )

    @property
    def state(self) -> ModelState:
        """Pose and velocity of the base, as last received.

        Raises:
            ClientError: No odometry was received yet; see ``wait``.
        """
        if self._state is None:
            raise ClientError(f"no message yet on {self._pose_topic} ", hint="call wait() first")
        return self._state

    def wait(self, timeout: float = 10.0) -> Self:
        """Wait until the base has subscribed and its pose is known.

        Raises:
            ClientError: It takes longer than ``timeout`` [s of wall time].
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

    def _receive_pose(self, message: geometry_msgs.msg.Pose) -> None:
        place = read_state(message, twist_message(_ZERO, _ZERO))
        self._state = ModelState(place.position, place.quaternion, _UNKNOWN, _UNKNOWN)
        self._arrived.set()

    def _receive(self, message: nav_msgs.msg.Odometry) -> None:
        self._state = read_state(message.pose.pose, message.twist.twist)
        self._arrived.set()
