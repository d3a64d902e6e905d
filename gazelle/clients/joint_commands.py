"""Command joints through controllers of ros_controllers that take one value a joint."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from gazelle.argument_checks import checked
from gazelle.clients.errors import ClientError
from gazelle.errors import did_you_mean
from gazelle_ros import Node
from gazelle_ros.base.closing import Closeable
from gazelle_ros.base.deadlines import deadline_after
from gazelle_ros.msgs import sensor_msgs, std_msgs

_LOOK_S = 0.01
Progress = Callable[[Mapping[str, float]], object]
"""Called with how far each joint has still to go [rad or m]."""


@checked(ClientError, after=True)
class JointCommander(Closeable):
    """Sends commands to one controller, and watches its joints.

    The controller's parameters say which joints it has: ``joint`` for those that take one number
    (``effort_controllers/JointPositionController`` and its kin), ``joints`` for groups.

    Args:
        node: Publishes and subscribes.
        controller: Its name.
        namespace: Of the robot.
        states: Topic of ``sensor_msgs/JointState``; the namespace's ``joint_states`` if None.

    Raises:
        ClientError: There is no such controller on the parameter server, or it names no joint.
    """

    def __init__(
        self, node: Node, controller: str, namespace: str = "/", *, states: str | None = None
    ) -> None:
        space = f"/{namespace.strip('/')}".rstrip("/")
        self.topic = f"{space}/{controller}/command"
        self.joints, group = _joints_of(node, f"{space}/{controller}")
        self._states_topic = states or f"{space}/joint_states"
        self._kind: Any = std_msgs.msg.Float64MultiArray if group else std_msgs.msg.Float64
        self._positions: dict[str, float] = {}
        self._news = threading.Condition()
        self._publisher = node.advertise(self.topic, self._kind, 1)
        self._subscriber = node.subscribe(
            self._states_topic, sensor_msgs.msg.JointState, self._receive, 1
        )

    @property
    def positions(self) -> dict[str, float]:
        """Positions of its joints, as last received [rad or m]."""
        return {name: self._positions[name] for name in self.joints if name in self._positions}

    def wait(self, timeout: float = 30.0) -> None:
        """Wait until the controller has subscribed.

        Raises:
            ClientError: It takes longer than ``timeout`` [s of wall time].
        """
        deadline = deadline_after(timeout)
        while not self._publisher.num_connections:
            if time.monotonic() > deadline:
                raise ClientError(
                    f"no subscriber on {self.topic} after {timeout:g} s",
                    hint="is the controller loaded?",
                )
            time.sleep(_LOOK_S)

    def send(
        self, targets: float | Sequence[float] | Mapping[str, float], timeout: float = 30.0
    ) -> None:
        """Send a command; it holds until the next.

        Args:
            targets: One for each joint, in the controller's order, or by name; one number is for all
                [rad, m, rad/s, m/s, N m or N, as the controller takes it].
            timeout: For the controller to subscribe [s of wall time].

        Raises:
            ClientError: A joint is unknown or left out, or there is no subscriber.
        """
        values = self._in_order(targets)
        self.wait(timeout)
        many = self._kind._type == "std_msgs/Float64MultiArray"
        self._publisher.publish(self._kind(data=values if many else values[0]))

    def move(
        self,
        targets: float | Sequence[float] | Mapping[str, float],
        *,
        tolerance: float = 0.01,
        timeout: float = 30.0,
        progress: Progress | None = None,
    ) -> dict[str, float]:
        """Send positions to a position controller, and wait until all joints are there.

        Args:
            targets: As for ``send`` [rad or m].
            tolerance: Largest error of a joint [rad or m].
            timeout: For all of it [s of wall time].
            progress: Called with the rest at each message of the joints.

        Returns:
            Where the joints are.

        Raises:
            ClientError: As ``send``, and when a joint does not come there in time.
        """
        deadline = deadline_after(timeout)
        positions = dict(zip(self.joints, self._in_order(targets), strict=True))
        self.send(positions, timeout)
        while True:
            with self._news:
                received = self._news.wait(max(0.0, deadline - time.monotonic()))
                there = self.positions
            left = {name: positions[name] - value for name, value in there.items()}
            if received and progress is not None:
                progress(left)
            if (
                received
                and set(left) == set(positions)
                and max(map(abs, left.values())) <= tolerance
            ):
                return there
            if time.monotonic() > deadline:
                raise ClientError(self._not_there(left, positions, timeout))

    def close(self) -> None:
        """Leave the topics; the last command stays in effect."""
        self._publisher.close()
        self._subscriber.close()

    def _not_there(
        self, left: Mapping[str, float], targets: Mapping[str, float], timeout: float
    ) -> str:
        missing = [name for name in targets if name not in left]
        if missing:
            return f"nothing of '{missing[0]}' came on {self._states_topic} in {timeout:g} s"
        worst = max(left, key=lambda name: abs(left[name]))
        return f"'{worst}' is still {left[worst]:.4g} away from {targets[worst]:.4g} after {timeout:g} s"

    def _in_order(self, targets: float | Sequence[float] | Mapping[str, float]) -> list[float]:
        if isinstance(targets, Mapping):
            return _by_name(targets, self.joints, self.topic)
        values = [float(targets)] if isinstance(targets, int | float) else list(map(float, targets))
        if len(values) == 1:
            return values * len(self.joints)
        if len(values) != len(self.joints):
            raise ClientError(
                f"{self.topic} takes {len(self.joints)} values ({', '.join(self.joints)}), "
                f"not {len(values)}"
            )
        return values

    def _receive(self, message: sensor_msgs.msg.JointState) -> None:
        with self._news:
            self._positions |= dict(zip(message.name, message.position, strict=False))
            self._news.notify_all()


def _by_name(targets: Mapping[str, float], joints: Sequence[str], topic: str) -> list[float]:
    """Return targets in a controller's order.

    Raises:
        ClientError: One is missing, or is of no joint of it.
    """
    for name in targets:
        if name not in joints:
            raise ClientError(f"{topic}: no joint '{name}'", hint=did_you_mean(name, joints))
    for name in joints:
        if name not in targets:
            raise ClientError(f"{topic} takes a value for every joint, and '{name}' has none")
    return [float(targets[name]) for name in joints]


def _joints_of(node: Node, place: str) -> tuple[tuple[str, ...], bool]:
    """Return the joints that a controller's parameters name, and whether it is one of a group."""
    parameters = node.get_param(place, None)
    if not isinstance(parameters, Mapping):
        raise ClientError(f"there are no parameters of a controller at {place}")
    if isinstance(parameters.get("joint"), str):
        return (parameters["joint"],), False
    joints = parameters.get("joints")
    if isinstance(joints, Sequence) and joints:
        return tuple(map(str, joints)), True
    raise ClientError(f"{place} has neither a parameter 'joint' nor 'joints'")
