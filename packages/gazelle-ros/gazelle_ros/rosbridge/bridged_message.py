"""A message on its way to clients, encoded once for all clients of one encoding."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable
from typing import Any

from gazelle_ros.raw import RawMessage
from gazelle_ros.rosbridge.cbor import cbor_values
from gazelle_ros.rosbridge.fragments import text_as_png
from gazelle_ros.rosbridge.values import json_values

COMPRESSIONS = ("none", "png", "cbor", "cbor-raw")
"""In the order in which a wish wins over those before it."""


class BridgedMessage:
    """One message of a topic.

    Args:
        topic: As clients call it.
        message_class: Of the message.
        data: The message, serialised.
        received: Time of arrival, on the graph's clock [ns].
    """

    def __init__(self, topic: str, message_class: Any, data: bytes, received: int) -> None:
        self._topic, self._class, self._data = topic, message_class, data
        self._received = received
        self._lock = threading.Lock()
        self._made: dict[str, str | bytes] = {}

    def __len__(self) -> int:
        """Return the number of bytes of the serialised message."""
        return len(self._data)

    def encoded(self, compression: str) -> str | bytes:
        """Return the ``publish`` message for clients.

        Raises:
            DeserializationError: The bytes are no such message.
        """
        with self._lock:
            if compression not in self._made:
                self._made[compression] = _ENCODE[compression](self)
            return self._made[compression]

    def _json(self) -> str:
        message = self._class().deserialize(self._data, numpy=True)
        return json.dumps({"op": "publish", "topic": self._topic, "msg": json_values(message)})

    def _png(self) -> str:
        return json.dumps({"op": "png", "data": text_as_png(self._json())})

    def _cbor(self) -> bytes:
        message = self._class().deserialize(self._data, numpy=True)
        return self._cbor_of(cbor_values(message))

    def _cbor_raw(self) -> bytes:
        secs, nsecs = divmod(self._received, 1_000_000_000)
        return self._cbor_of({"secs": secs, "nsecs": nsecs, "bytes": bytes(self._data)})

    def _cbor_of(self, values: dict[str, Any]) -> bytes:
        import cbor2

        data: bytes = cbor2.dumps({"op": "publish", "topic": self._topic, "msg": values})
        return data


_ENCODE: dict[str, Callable[[BridgedMessage], str | bytes]] = {
    "none": BridgedMessage._json,  # noqa: SLF001
    "png": BridgedMessage._png,  # noqa: SLF001
    "cbor": BridgedMessage._cbor,  # noqa: SLF001
    "cbor-raw": BridgedMessage._cbor_raw,  # noqa: SLF001
}


class TopicEncoder:
    """Makes the `BridgedMessage` of each message of a topic, the same for all clients."""

    def __init__(self, topic: str, message_class: Any, now: Callable[[], int]) -> None:
        self._topic, self._class, self._now = topic, message_class, now
        self._last: tuple[Any, BridgedMessage] | None = None

    def message(self, raw: RawMessage) -> BridgedMessage:
        """Return the message as clients get it."""
        last = self._last
        if last is not None and last[0] is raw:
            return last[1]
        made = BridgedMessage(self._topic, self._class, raw._buff, self._now())
        self._last = raw, made
        return made
