"""Commands of a joystick's buttons: publish a message, send a goal, call a service."""

from __future__ import annotations

import logging
import threading
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from gazelle_ros.actions import SimpleActionClient
from gazelle_ros.base.errors import Error, RosError, did_you_mean
from gazelle_ros.base.parameter_values import value_of
from gazelle_ros.errors import report
from gazelle_ros.messages import load_message, load_service
from gazelle_ros.messages.yaml import fill_message_args
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.node import Node
from gazelle_ros.time import Time
from gazelle_ros.tools.graph import GraphInspector
from gazelle_ros.tools.services import service_type

_LOG = logging.getLogger("gazelle.ros.joy")
_PATIENCE_S = 2.0


@dataclass(frozen=True, slots=True)
class ButtonMatch:
    """Buttons that run a command.

    Attributes:
        buttons: Numbers of the buttons, all of which are pressed.
        others: Other buttons may be pressed, too.
    """

    buttons: Sequence[int]
    others: bool

    def fits(self, pressed: Sequence[int]) -> bool:
        """Return whether a joystick's buttons, 0 or 1, run the command."""
        if not all(0 <= each < len(pressed) and pressed[each] == 1 for each in self.buttons):
            return False
        count = sum(pressed)
        return count >= len(self.buttons) if self.others else count == len(self.buttons)


class ButtonCommand(ABC):
    """A command of a joystick.

    Args:
        name: Of the command.
        match: The buttons that run it.
    """

    def __init__(self, name: str, match: ButtonMatch) -> None:
        self.name, self.match = name, match

    @abstractmethod
    def run(self, joy: sensor_msgs.msg.Joy, *, changed: bool) -> None:
        """Run it.

        Args:
            joy: State of the joystick.
            changed: Whether its buttons are others than the last time.
        """


class TopicCommand(ButtonCommand):
    """Message that is published with each state of the joystick.

    Args:
        node: On the graph.
        name: Of the command.
        match: The buttons that run it.
        parameters: ``topic_name``, ``message_type``, and ``axis_mappings`` or ``message_value``.

    Raises:
        Error: A parameter is missing or wrong.
    """

    def __init__(
        self, node: Node, name: str, match: ButtonMatch, parameters: Mapping[str, Any]
    ) -> None:
        super().__init__(name, match)
        self._node = node
        self._kind: Any = load_message(str(_needed(name, parameters, "message_type")))
        self._values = parameters.get("message_value")
        self._axes = parameters.get("axis_mappings", [])
        if self._values is None and "axis_mappings" not in parameters:
            raise RosError(f"the command '{name}' has no axis_mappings or message_value")
        for each in self._axes if self._values is None else self._values:
            _field_of(self._kind(), str(_needed(name, each, "target")))
        self._warned = False
        self._publisher = node.advertise(
            str(_needed(name, parameters, "topic_name")), self._kind, 1
        )

    def run(self, joy: sensor_msgs.msg.Joy, *, changed: bool) -> None:
        """Publish the message."""
        del changed
        message = self._kind()
        if self._values is not None:
            for each in self._values:
                _set(message, each["target"], each.get("value"))
        else:
            for each in self._axes:
                _set(message, each["target"], self._mapped(joy, each))
        if hasattr(message, "header"):
            message.header.stamp = Time(nsecs=self._node.clock.now())
        self._publisher.publish(message)

    def _mapped(self, joy: sensor_msgs.msg.Joy, mapping: Mapping[str, Any]) -> float:
        kind = "axis" if "axis" in mapping else "button"
        values = joy.axes if kind == "axis" else joy.buttons
        number = mapping.get(kind, -1)
        if not 0 <= number < len(values):
            if not self._warned:
                self._warned = True
                _LOG.error(
                    "the joystick has %d of what '%s' maps as %s %d, counted from 0",
                    len(values), self.name, kind, number,
                )  # fmt: skip
            return 0.0
        scale, offset = value_of(mapping, "scale", 1.0), value_of(mapping, "offset", 0.0)
        found: float = float(values[number]) * scale + offset
        return found


class RequestCommand(ButtonCommand):
    """Request that is sent once when its buttons are pressed, and not before the last one ended.

    Args:
        name: Of the command.
        match: The buttons that run it.
        send: Sends it, on a thread of its own.
    """

    def __init__(self, name: str, match: ButtonMatch, send: Callable[[], None]) -> None:
        super().__init__(name, match)
        self._send = send
        self._thread: threading.Thread | None = None

    def run(self, joy: sensor_msgs.msg.Joy, *, changed: bool) -> None:
        """Send the request, if the buttons changed."""
        del joy
        if not changed:
            return
        if self._thread is not None and self._thread.is_alive():
            _LOG.info("'%s' is not sent again: the last request has not ended", self.name)
            return
        self._thread = threading.Thread(target=self._try, name=self.name, daemon=True)
        self._thread.start()

    def _try(self) -> None:
        try:
            self._send()
        except Error as error:
            _LOG.error("'%s' is not run: %s", self.name, error)  # the graph's fault
        except Exception as error:  # noqa: BLE001  # the joystick's other commands go on
            report(f"the command {self.name}", error)


def action_command(
    node: Node, name: str, match: ButtonMatch, parameters: Mapping[str, Any]
) -> RequestCommand:
    """Return a command that sends a goal: ``action_name`` and ``action_goal``.

    Raises:
        RosError: A parameter is missing.
    """
    action = str(_needed(name, parameters, "action_name"))
    clients: list[SimpleActionClient] = []

    def send() -> None:
        topic = node.resolve(action) + "/goal"
        kind = dict(node.master.topic_types()).get(topic, "").removesuffix("Goal")
        if not kind:
            raise RosError(f"there is no action {node.resolve(action)}")
        if not clients:
            clients.append(SimpleActionClient(node, action, load_message(kind)))
        if not clients[0].wait_for_server(_PATIENCE_S):
            raise RosError(f"the action {node.resolve(action)} does not answer")
        goal: Any = load_message(f"{kind.removesuffix('Action')}Goal")()
        fill_message_args(goal, [parameters.get("action_goal") or {}])
        clients[0].send_goal(goal)

    return RequestCommand(name, match, send)


def service_command(
    node: Node, name: str, match: ButtonMatch, parameters: Mapping[str, Any]
) -> RequestCommand:
    """Return a command that calls a service: ``service_name`` and ``service_request``.

    Raises:
        RosError: A parameter is missing.
    """
    service = node.resolve(str(_needed(name, parameters, "service_name")))

    def send() -> None:
        with GraphInspector(node.name, node.master_uri) as graph:
            kind = load_service(service_type(graph, service))
        request = kind._request_class()
        fill_message_args(request, [parameters.get("service_request") or {}])
        client = node.client(service, kind)
        try:
            client.call(request)
        finally:
            client.close()

    return RequestCommand(name, match, send)


def _needed(name: str, parameters: Any, key: str) -> Any:
    if not isinstance(parameters, Mapping) or key not in parameters:
        raise RosError(f"the command '{name}' has no '{key}' in {parameters!r:.60}")
    return parameters[key]


def _field_of(message: Any, path: str) -> tuple[Any, str]:
    """Return the message that has the last field of a path, such as ``linear.x``, and its name.

    Raises:
        RosError: There is no such field.
    """
    *way, last = path.split(".")
    for each in (*way, last):
        slots = getattr(message, "__slots__", ())
        if each not in slots:
            raise RosError(f"there is no field '{path}'", hint=did_you_mean(each, slots))
        if each is not last:
            message = getattr(message, each)
    return message, last


def _set(message: Any, path: str, value: Any) -> None:
    """Set a field; numbers become those of its type."""
    target, name = _field_of(message, path)
    now = getattr(target, name)
    if isinstance(value, int | float) and isinstance(now, bool | int | float):
        value = type(now)(value)
    setattr(target, name, value)
