"""Session of one client of a rosbridge server: its requests and the answers."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable
from typing import Any

from gazelle_ros.base.errors import Error, RosError, did_you_mean
from gazelle_ros.errors import report
from gazelle_ros.node import Node
from gazelle_ros.rosbridge.bridged_message import COMPRESSIONS
from gazelle_ros.rosbridge.client_queue import ClientQueue, DeliverySettings
from gazelle_ros.rosbridge.client_services import MOST_CALLS, ServicePool, call_service
from gazelle_ros.rosbridge.client_topics import ClientTopics, TopicTypes
from gazelle_ros.rosbridge.fragments import FragmentBuffer, split_text, text_of_png
from gazelle_ros.rosbridge.operation_fields import OperationFields
from gazelle_ros.rosbridge.settings import BridgeSettings
from gazelle_ros.rosbridge.shared_publishers import PublisherPool

_LEVELS = ("none", "error", "warning", "info")
_MOST_NESTED = 3  # fragments in PNGs in fragments


class BridgeContext:
    """State that the clients of a server share.

    Args:
        node: On the graph.
        settings: Of the server.
    """

    def __init__(self, node: Node, settings: BridgeSettings) -> None:
        self.node, self.settings = node, settings
        self.types = TopicTypes(node)
        self.publishers = PublisherPool(node, settings.unregister_timeout)
        self.services = ServicePool(node)


class BridgeSession:
    """One client: takes its messages, and fills its outbox.

    Args:
        context: Shared by all clients.
        outbox: The client's.
    """

    def __init__(self, context: BridgeContext, outbox: ClientQueue) -> None:
        self._context, self._settings, self._outbox = context, context.settings, outbox
        self._topics = ClientTopics(context.node, context.types, context.publishers, outbox)
        self._fragments = FragmentBuffer(
            self._settings.max_incoming_bytes, self._settings.fragment_timeout
        )
        self._level = "error"
        self._lock = threading.Lock()
        self._calls = 0
        self._fragment_number = 0
        self.closed = False
        self._operations: dict[str, Callable[[OperationFields], None]] = {
            "advertise": self._advertise,
            "unadvertise": self._unadvertise,
            "publish": self._publish,
            "subscribe": self._subscribe,
            "unsubscribe": self._unsubscribe,
            "call_service": self._call_service,
            "advertise_service": self._advertise_service,
            "unadvertise_service": self._unadvertise_service,
            "service_response": self._service_response,
            "set_level": self._set_level,
            "status": self._status_from_client,
            "auth": self._auth,
        }

    def receive(self, text: str | bytes) -> None:
        """Process a message of the client; its errors are answered as a status."""
        if isinstance(text, bytes):
            self.status("error", "binary messages are not taken: send JSON as text")
            return
        self._take(text, 0)

    def close(self) -> None:
        """Undo all that the client did, at its end."""
        self.closed = True
        self._context.services.withdraw_all(self)
        self._topics.close()

    def status(self, level: str, text: str, identifier: Any = None) -> None:
        """Send a status to the client, if it wants that level."""
        if _LEVELS.index(level) <= _LEVELS.index(self._level):
            self._send({"op": "status", "level": level, "msg": text}, identifier)

    # Messages ------------------------------------------------------------------------------

    def _take(self, text: str, depth: int) -> None:
        try:
            message = json.loads(text)
        except (ValueError, RecursionError) as error:
            self.status("error", f"the message is not valid JSON ({error}): {text[:80]}")
            return
        if not isinstance(message, dict):
            self.status("error", f"the message is not a JSON object: {text[:80]}")
            return
        identifier, operation = message.get("id"), message.get("op")
        known = [*self._operations, "fragment", "png"]
        if not isinstance(operation, str) or operation not in known:
            wrong = "Received a message without an op" if operation is None else (
                f"Unknown operation: {str(operation)[:80]}"
            )  # fmt: skip
            hint = did_you_mean(str(operation), known) if operation is not None else ""
            allowed = f"Allowed operations: {', '.join(sorted(known))}"
            self.status("error", f"{wrong}. {hint or allowed}", identifier)
            return
        try:
            self._do(operation, OperationFields(message), depth)
        except Error as error:
            hint = f"; {error.hint}" if error.hint else ""
            self.status("error", f"{operation}: {error.message}{hint}", identifier)
        except Exception as error:  # noqa: BLE001  # one client's message ends no connection
            report(f"rosbridge's {operation}", error)
            self.status("error", f"{operation}: {error}", identifier)

    def _do(self, operation: str, message: OperationFields, depth: int) -> None:
        if operation not in {"fragment", "png"}:
            self._operations[operation](message)
            return
        if depth >= _MOST_NESTED:
            raise RosError("fragments and PNGs are nested too deeply")
        data = message.text("data")
        if message.get("num") is not None or operation == "fragment":
            whole = self._fragments.add(
                str(message.any("id")), message.integer("num"), message.integer("total"), data
            )
            if whole is None:
                return
            data = whole
        if operation == "png":
            data = text_of_png(data, self._settings.max_incoming_bytes).rstrip("\n")
        self._take(data, depth + 1)

    def _send(self, message: dict[str, Any], identifier: Any = None, size: Any = None) -> None:
        if identifier is not None:
            message["id"] = identifier
        text = json.dumps(message)
        size = size or self._settings.max_message_size
        if size is None or len(text) <= size:
            self._outbox.answer(text)
            return
        with self._lock:
            self._fragment_number += 1
            name = str(self._fragment_number if identifier is None else identifier)
        for piece in split_text(text, size, name):
            self._outbox.answer(piece)

    # Topics --------------------------------------------------------------------------------

    def _topic(self, message: OperationFields) -> str:
        topic = message.text("topic")
        if not self._settings.may_use_topic(topic):
            raise RosError(f"topics_glob of this server does not let clients use {topic}")
        return topic

    def _advertise(self, message: OperationFields) -> None:
        topic, kind = self._topic(message), message.text("type")
        size, latch = _publishing(message)
        self._topics.advertise(topic, kind, message.get("id"), size=size, latch=latch)
        self.status("info", f"Advertised {topic}", message.get("id"))

    def _unadvertise(self, message: OperationFields) -> None:
        topic = self._topic(message)
        if not self._topics.unadvertise(topic, message.get("id")):
            self.status("warning", f"{topic} was not advertised", message.get("id"))

    def _publish(self, message: OperationFields) -> None:
        topic = self._topic(message)
        size, latch = _publishing(message)
        self._topics.publish(topic, message.get("msg", {}), size=size, latch=latch)

    def _subscribe(self, message: OperationFields) -> None:
        topic = self._topic(message)
        wish = DeliverySettings(
            throttle=message.number("throttle_rate", 0.0) / 1000.0,
            queue_length=message.integer("queue_length", 0),
            fragment_size=_positive(message, "fragment_size"),
            compression=message.text("compression", "none"),
        )
        if wish.compression not in COMPRESSIONS:
            raise RosError(
                f"there is no compression '{wish.compression}'",
                hint=f"there are: {', '.join(COMPRESSIONS)}",
            )
        if wish.queue_length < 0:
            raise RosError("queue_length is below zero")
        kind = message.text("type", "") or None
        self._topics.subscribe(topic, kind, message.get("id"), wish)
        self.status("info", f"Subscribed to {topic}", message.get("id"))

    def _unsubscribe(self, message: OperationFields) -> None:
        self._topics.unsubscribe(self._topic(message), message.get("id"))

    # Services ------------------------------------------------------------------------------

    def _service(self, message: OperationFields) -> str:
        service = message.text("service")
        if not self._settings.may_use_service(service):
            raise RosError(f"services_glob of this server does not let clients use {service}")
        return service

    def _call_service(self, message: OperationFields) -> None:
        """Call it on another thread, so that the client may say more meanwhile."""
        service = self._service(message)
        name, _, old_style = service.partition("#")  # /rosapi/topics#33: the id in the name
        identifier = message.get("id", old_style or None)
        timeout = message.number("timeout", 0.0) or None
        size = _positive(message, "fragment_size")
        arguments = message.get("args")
        with self._lock:
            if self._calls >= MOST_CALLS:
                raise RosError(f"{MOST_CALLS} calls of this client wait for their answers already")
            self._calls += 1

        def call() -> None:
            try:
                values: Any = call_service(self._context.node, name, arguments, timeout)
                result = True
            except Exception as error:  # noqa: BLE001  # whatever fails is the client's to know
                if not isinstance(error, Error | TimeoutError):
                    report(f"rosbridge's call of {name}", error)
                values, result = getattr(error, "message", str(error)), False
                self.status("error", f"call_service {name}: {values}", identifier)
            finally:
                with self._lock:
                    self._calls -= 1
            self._send(
                {"op": "service_response", "service": service, "values": values, "result": result},
                identifier,
                size,
            )

        self._context.node.loop.submit(call)

    def _advertise_service(self, message: OperationFields) -> None:
        service, kind = self._service(message), message.text("type")
        if self._context.services.offer(self, service, kind, self._send):
            self.status("warning", f"{service} was advertised before; this takes its place")
        self.status("info", f"Advertised service {service}", message.get("id"))

    def _unadvertise_service(self, message: OperationFields) -> None:
        service = self._service(message)
        if not self._context.services.withdraw(self, service):
            raise RosError(f"Service {service} has not been advertised via rosbridge")

    def _service_response(self, message: OperationFields) -> None:
        self._context.services.respond(
            self,
            self._service(message),
            message.get("id"),
            message.get("values"),
            result=message.flag("result"),
        )

    # The connection ------------------------------------------------------------------------

    def _set_level(self, message: OperationFields) -> None:
        level = message.text("level")
        if level not in _LEVELS:
            raise RosError(f"there is no level '{level}'", hint=f"there are: {', '.join(_LEVELS)}")
        self._level = level

    def _status_from_client(self, _message: OperationFields) -> None:
        """Ignore a client's status."""

    def _auth(self, _message: OperationFields) -> None:
        raise RosError(
            "this server does not support authentication",
            hint="leave 'auth' out",
        )


def _positive(message: OperationFields, name: str) -> int | None:
    """Return an int above zero, or None."""
    if message.get(name) is None:
        return None
    value = message.integer(name)
    if value < 1:
        raise RosError(f"{name} must be an int above zero, not {value}")
    return value


def _publishing(message: OperationFields) -> tuple[int, bool]:
    """Return queue size and latching of a publisher."""
    size = message.integer("queue_size", 100)
    if size < 1:
        raise RosError(f"queue_size must be an int above zero, not {size}")
    return size, message.flag("latch", default=False)
