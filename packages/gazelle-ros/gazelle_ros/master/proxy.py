"""Client of the master's API."""

from __future__ import annotations

from typing import Any

from gazelle_ros.base.program import program_name
from gazelle_ros.errors import (
    ApiError,
    FaultError,
    MarshalError,
    MasterUnreachableError,
    NoListeningMasterError,
    NoMasterError,
    ProtocolError,
    SilentPeerError,
    UnreachableError,
)
from gazelle_ros.limits import LIMITS, NetworkLimits
from gazelle_ros.xmlrpc.client import BlockingClient

GREETING_S = 10.0
"""A master that does not identify itself within this time is none [s]."""


def taken_hint() -> str:
    """Return what to do where another program has the master's port."""
    name = program_name()
    return (
        f"give the master another port, '{name} master --port 11312' or '{name} launch --port 11312', "
        "and everything else ROS_MASTER_URI=http://localhost:11312"
    )


def value_of(method: str, triple: Any) -> Any:
    """Return the value of an answer.

    Raises:
        ApiError: Its code is not 1.
        ProtocolError: It is not a triple.
    """
    if not isinstance(triple, list) or len(triple) != 3:
        raise ProtocolError(f"{method} was answered with {str(triple)[:80]}")
    if triple[0] != 1:
        raise ApiError(method, int(triple[0]), str(triple[1]))
    return triple[2]


class MasterProxy:
    """The API of a master, called from any thread.

    All methods raise `MasterUnreachableError` if it does not answer and `ApiError` if it
    refuses.

    Args:
        uri: Of the master.
        caller: Name of the calling node.
        timeout: Seconds to wait for an answer.
    """

    def __init__(
        self, uri: str, caller: str, timeout: float = 30.0, limits: NetworkLimits = LIMITS
    ) -> None:
        self.uri = uri
        self.caller = caller
        self._client = BlockingClient(uri, timeout, limits)

    def call(self, method: str, *params: Any) -> Any:
        """Call any method with the caller's name first; returns the value of its triple."""
        return value_of(method, self.call_raw(method, *params))

    def call_raw(self, method: str, *params: Any) -> Any:
        """Call any method; returns the whole triple."""
        try:
            return self._client.call(method, self.caller, *params)
        except SilentPeerError:
            raise _no_master(self.uri, "it does not answer") from None
        except ProtocolError as error:
            raise _no_master(self.uri, error.message) from None
        except UnreachableError as error:
            reason = error.message.removeprefix(f"{self.uri} does not answer: ")
            refused = isinstance(error, ConnectionRefusedError)
            kind = NoListeningMasterError if refused else MasterUnreachableError
            raise kind(
                f"the ROS master at {self.uri} does not answer ({reason})",
                hint=f"start one with '{program_name()} master', or set ROS_MASTER_URI",
            ) from None

    def close(self) -> None:
        """Close the connections."""
        self._client.close()

    def get_pid(self) -> int:
        """Return process of the master."""
        return int(self.call("getPid"))

    def greet(self) -> int:
        """Return the process of the master, with a short timeout.

        Raises:
            MasterUnreachableError: There is no server.
            NoMasterError: The server is no master.
        """
        brief = MasterProxy(self.uri, self.caller, GREETING_S)
        try:
            return brief.get_pid()
        except (FaultError, MarshalError, ProtocolError, ValueError) as error:
            raise _no_master(self.uri, str(error)) from None
        finally:
            brief.close()

    def get_uri(self) -> str:
        """Return the URI the master has for itself."""
        return str(self.call("getUri"))

    def lookup_node(self, name: str) -> str:
        """Return URI of a node."""
        return str(self.call("lookupNode", name))

    def lookup_service(self, name: str) -> str:
        """Return address of a service, ``rosrpc://HOST:PORT``."""
        return str(self.call("lookupService", name))

    def published_topics(self, subgraph: str = "") -> list[tuple[str, str]]:
        """Return topics with publishers in a namespace, and their types."""
        return [(topic, kind) for topic, kind in self.call("getPublishedTopics", subgraph)]

    def topic_types(self) -> list[tuple[str, str]]:
        """Return all topics the master knows a type of."""
        return [(topic, kind) for topic, kind in self.call("getTopicTypes")]

    def system_state(
        self,
    ) -> tuple[dict[str, list[str]], dict[str, list[str]], dict[str, list[str]]]:
        """Return publishers by topic, subscribers by topic, providers by service."""
        pubs, subs, services = self.call("getSystemState")
        return dict(pubs), dict(subs), dict(services)

    def register_publisher(self, topic: str, kind: str, uri: str) -> list[str]:
        """Register a publisher; returns the URIs of the subscribers."""
        return list(self.call("registerPublisher", topic, kind, uri))

    def unregister_publisher(self, topic: str, uri: str) -> bool:
        """Unregister a publisher; False if it was not registered."""
        return bool(self.call("unregisterPublisher", topic, uri))

    def register_subscriber(self, topic: str, kind: str, uri: str) -> list[str]:
        """Register a subscriber; returns the URIs of the publishers."""
        return list(self.call("registerSubscriber", topic, kind, uri))

    def unregister_subscriber(self, topic: str, uri: str) -> bool:
        """Unregister a subscriber; False if it was not registered."""
        return bool(self.call("unregisterSubscriber", topic, uri))

    def register_service(self, name: str, address: str, uri: str) -> None:
        """Provide a service."""
        self.call("registerService", name, address, uri)

    def unregister_service(self, name: str, address: str) -> bool:
        """Unregister a service; False if it was not registered."""
        return bool(self.call("unregisterService", name, address))

    def get_param(self, key: str) -> Any:
        """Return the value of a parameter."""
        return self.call("getParam", key)

    def set_param(self, key: str, value: Any) -> None:
        """Set a parameter."""
        self.call("setParam", key, value)

    def has_param(self, key: str) -> bool:
        """Return True if it is set."""
        return bool(self.call("hasParam", key))

    def delete_param(self, key: str) -> None:
        """Remove a parameter."""
        self.call("deleteParam", key)

    def search_param(self, key: str) -> str:
        """Return the name of the nearest parameter of that name."""
        return str(self.call("searchParam", key))

    def param_names(self) -> list[str]:
        """Return all keys that hold a value."""
        return list(self.call("getParamNames"))

    def subscribe_param(self, key: str, uri: str) -> Any:
        """Subscribe to changes; returns the value now, ``{}`` if there is none."""
        return self.call("subscribeParam", uri, key)

    def unsubscribe_param(self, key: str, uri: str) -> None:
        """Unsubscribe from changes."""
        self.call("unsubscribeParam", uri, key)


def _no_master(uri: str, why: str) -> NoMasterError:
    """Return the error for a port that something else uses."""
    return NoMasterError(f"what listens at {uri} is not a ROS master ({why})", hint=taken_hint())
