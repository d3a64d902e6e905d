"""Settings of a rosbridge server: parameters of its node, and command-line arguments."""

from __future__ import annotations

import fnmatch
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from typing import Any

from gazelle_ros.base.characters import can_be_written
from gazelle_ros.base.deadlines import LONGEST_WAIT
from gazelle_ros.base.errors import RosError, did_you_mean
from gazelle_ros.net import MAX_PORT
from gazelle_ros.node import Node

_MEBI = 1024 * 1024


@dataclass(frozen=True, slots=True)
class BridgeSettings:
    """Settings of a rosbridge server: where it listens, and the permissions of clients.

    The names are those of rosbridge_server's parameters; the last four are our own. Values may be
    text, as on a command line; no address stands for all.

    Raises:
        RosError: A value is missing or of another type.
    """

    port: int = 9090
    """0 for any free one."""
    address: str = "127.0.0.1"
    """Of the interface; ``0.0.0.0`` for all."""
    certfile: str = ""
    keyfile: str = ""
    retry_startup_delay: float = 2.0
    """Seconds until the port is tried again when it is taken; 0 to give up."""
    fragment_timeout: float = 600.0
    """Seconds after which pieces of a message that never got whole are forgotten."""
    delay_between_messages: float = 0.0
    """Pause after each message to a client [s]."""
    max_message_size: int | None = None
    """Longer messages to clients go out as fragments [characters]."""
    unregister_timeout: float = 10.0
    """A topic stays advertised so long after its last client left [s]."""
    use_compression: bool = False
    """Offer WebSockets' own compression."""
    websocket_ping_interval: float = 0.0
    """Seconds between pings; 0 for none."""
    websocket_ping_timeout: float = 30.0
    websocket_null_origin: bool = False
    """Let pages in without an origin: files, and any site's sandboxed frames."""
    topics_glob: tuple[str, ...] = ()
    services_glob: tuple[str, ...] = ()
    params_glob: tuple[str, ...] = ()
    """Patterns of what clients may use; none for all."""
    allowed_origins: tuple[str, ...] = ()
    """Patterns of web pages that may connect, besides those of this machine."""
    max_incoming_bytes: int = 64 * _MEBI
    """Longest message from a client; a longer one ends its connection."""
    max_waiting_bytes: int = 16 * _MEBI
    """Largest queue of a slow client; beyond it the oldest messages of a topic are dropped."""
    max_clients: int = 1000

    def __post_init__(self) -> None:
        for each in fields(self):
            value = _BY_TYPE[str(each.type)](each.name, getattr(self, each.name))
            object.__setattr__(self, each.name, value)
        object.__setattr__(self, "address", self.address or "0.0.0.0")  # noqa: S104
        if self.port > MAX_PORT:
            raise RosError(f"port must be from 0 to {MAX_PORT}, not {self.port}")
        if bool(self.certfile) != bool(self.keyfile):
            raise RosError("give both 'certfile' and 'keyfile', or neither")

    def may_use_topic(self, topic: str) -> bool:
        """Return whether clients may publish and subscribe to a topic."""
        return matches(topic, self.topics_glob)

    def may_use_service(self, service: str) -> bool:
        """Return whether clients may call and offer a service; those of rosapi are always allowed."""
        return matches(service, self.services_glob) or service.startswith("/rosapi/")

    def may_use_parameter(self, name: str) -> bool:
        """Return whether clients may read and set a parameter."""
        return matches(name, self.params_glob)


def matches(name: str, patterns: Sequence[str]) -> bool:
    """Return whether a name matches one of the patterns; true if there are none."""
    return not patterns or any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)


def read_settings(node: Node, words: Sequence[str] = ()) -> BridgeSettings:
    """Read the settings of a node: its private parameters, and ``--NAME VALUE`` of its arguments.

    Raises:
        RosError: A value is missing or not supported.
    """
    given = {
        each.name: node.get_param(f"~{each.name}")
        for each in fields(BridgeSettings)
        if node.has_param(f"~{each.name}")
    }
    given |= _command_line(words)
    if _flag("authenticate", node.get_param("~authenticate", False)) or "authenticate" in given:
        raise RosError(
            "clients cannot be authenticated here: rosauth is not built in",
            hint="leave 'authenticate' false and the server on this machine, or let a proxy do it",
        )
    if _flag("bson_only_mode", node.get_param("~bson_only_mode", False)) or (
        str(node.get_param("~binary_encoder", "default")) == "bson" or "bson_only_mode" in given
    ):
        raise RosError(
            "BSON is not supported", hint="leave 'bson_only_mode' false; clients may ask for CBOR"
        )
    return BridgeSettings(**given)


def _command_line(words: Sequence[str]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    rest = list(words)
    while rest:
        word = rest.pop(0)
        name = word.removeprefix("--")
        if not word.startswith("--") or name not in {*_names(), *_SWITCHES}:
            raise RosError(
                f"'{word}' is not an option of rosbridge_websocket",
                hint=did_you_mean(word, [f"--{each}" for each in _names()]),
            )
        if name in _SWITCHES:
            found[name] = True
        elif rest:
            found[name] = rest.pop(0)
        else:
            raise RosError(f"--{name} argument provided without a value")
    return found


def _names() -> list[str]:
    return [each.name for each in fields(BridgeSettings)]


_SWITCHES = {"authenticate", "bson_only_mode"}


def _number(name: str, value: Any) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        number = -1.0
    if isinstance(value, bool) or not 0.0 <= number <= LONGEST_WAIT:
        raise RosError(f"{name} must be a number from 0 to {LONGEST_WAIT:g}, not {value!r:.60}")
    return number


def _integer(name: str, value: Any) -> int:
    number = _number(name, value)
    if number != int(number):
        raise RosError(f"{name} must be an int, not {value!r}")
    return int(number)


def _size(name: str, value: Any) -> int | None:
    if value is None or value in ("None", ""):
        return None
    size = _integer(name, value)
    if size < 1:
        raise RosError(f"{name} must be an int above zero, or None, not {value!r}")
    return size


def _flag(name: str, value: Any) -> bool:
    text = str(value).lower()
    if text not in {"true", "false", "1", "0"}:
        raise RosError(f"{name} must be true or false, not {value!r}")
    return text in {"true", "1"}


def _text(name: str, value: Any) -> str:
    text = "" if value is None else str(value)
    if not can_be_written(text):
        raise RosError(f"{name} must be a string, not {value!r:.60}")
    return text


def _patterns(name: str, value: Any) -> tuple[str, ...]:
    """Return patterns in rosbridge's form: ``[/a, '/b/*']``; a list, or None for none."""
    if value is None or value in ("None", ""):
        return ()
    if isinstance(value, str):
        if not (value.startswith("[") and value.endswith("]")):
            raise RosError(f"{name} must be a list such as [/odom, /cmd_*], not {value!r}")
        value = value[1:-1].split(",")
    if not isinstance(value, (list, tuple)):
        raise RosError(f"{name} must be a list such as [/odom, /cmd_*], not {value!r}")
    words = (str(each).strip().strip("'\"") for each in value)
    return tuple(word for word in words if word)


_BY_TYPE: dict[str, Callable[[str, Any], Any]] = {
    "int": _integer,
    "float": _number,
    "int | None": _size,
    "bool": _flag,
    "str": _text,
    "tuple[str, ...]": _patterns,
}
