"""The master's API as a class that raises."""

from __future__ import annotations

from typing import Any

from gazelle_ros.compat.rosgraph.names import make_caller_id
from gazelle_ros.compat.rosgraph.rosenv import get_master_uri
from gazelle_ros.errors import ApiError, RosError
from gazelle_ros.master.proxy import MasterProxy


class MasterException(Exception):  # noqa: N818  # rosgraph's names
    """Root of the errors of the master."""


class MasterFailure(MasterException):
    """The master failed."""


class MasterError(MasterException):
    """The master says that the caller is at fault."""


Error = MasterError
Failure = MasterFailure
ROSMasterException = MasterException


class Master:
    """The master's API; methods return the value and raise otherwise.

    Args:
        caller_id: Name of the caller.
        master_uri: Of the master, by default ROS_MASTER_URI.
    """

    def __init__(self, caller_id: str, master_uri: str | None = None) -> None:
        self.caller_id = make_caller_id(caller_id)
        self.master_uri = master_uri or get_master_uri()
        self.handle = MasterProxy(self.master_uri, self.caller_id)

    def _call(self, method: str, *params: Any) -> Any:
        try:
            return self.handle.call(method, *params)
        except ApiError as error:
            kind = MasterError if error.code == -1 else MasterFailure
            raise kind(error.text) from None

    def is_online(self) -> bool:
        """Return whether it answers."""
        try:
            self.handle.get_pid()
        except (RosError, OSError):
            return False
        return True

    # The names and their meanings are those of http://wiki.ros.org/ROS/Master_API.

    def getPid(self) -> int:  # noqa: D102, N802
        return int(self._call("getPid"))

    def getUri(self) -> str:  # noqa: D102, N802
        return str(self._call("getUri"))

    def getParam(self, key: str) -> Any:  # noqa: D102, N802
        return self._call("getParam", key)

    def setParam(self, key: str, value: Any) -> Any:  # noqa: D102, N802
        return self._call("setParam", key, value)

    def hasParam(self, key: str) -> bool:  # noqa: D102, N802
        return bool(self._call("hasParam", key))

    def deleteParam(self, key: str) -> Any:  # noqa: D102, N802
        return self._call("deleteParam", key)

    def searchParam(self, key: str) -> Any:  # noqa: D102, N802
        return self._call("searchParam", key)

    def subscribeParam(self, caller_api: str, key: str) -> Any:  # noqa: D102, N802
        return self._call("subscribeParam", caller_api, key)

    def unsubscribeParam(self, caller_api: str, key: str) -> Any:  # noqa: D102, N802
        return self._call("unsubscribeParam", caller_api, key)

    def getParamNames(self) -> list[str]:  # noqa: D102, N802
        return list(self._call("getParamNames"))

    def registerService(self, service: str, service_api: str, caller_api: str) -> Any:  # noqa: D102, N802
        return self._call("registerService", service, service_api, caller_api)

    def unregisterService(self, service: str, service_api: str) -> Any:  # noqa: D102, N802
        return self._call("unregisterService", service, service_api)

    def registerSubscriber(self, topic: str, topic_type: str, caller_api: str) -> Any:  # noqa: D102, N802
        return self._call("registerSubscriber", topic, topic_type, caller_api)

    def unregisterSubscriber(self, topic: str, caller_api: str) -> Any:  # noqa: D102, N802
        return self._call("unregisterSubscriber", topic, caller_api)

    def registerPublisher(self, topic: str, topic_type: str, caller_api: str) -> Any:  # noqa: D102, N802
        return self._call("registerPublisher", topic, topic_type, caller_api)

    def unregisterPublisher(self, topic: str, caller_api: str) -> Any:  # noqa: D102, N802
        return self._call("unregisterPublisher", topic, caller_api)

    def lookupNode(self, node_name: str) -> str:  # noqa: D102, N802
        return str(self._call("lookupNode", node_name))

    def lookupService(self, service: str) -> str:  # noqa: D102, N802
        return str(self._call("lookupService", service))

    def getTopicTypes(self) -> list[list[str]]:  # noqa: D102, N802
        return list(self._call("getTopicTypes"))

    def getPublishedTopics(self, subgraph: str) -> list[list[str]]:  # noqa: D102, N802
        return list(self._call("getPublishedTopics", subgraph))

    def getSystemState(self) -> list[Any]:  # noqa: D102, N802
        return list(self._call("getSystemState"))


def is_online(master_uri: str | None = None) -> bool:
    """Return whether a master answers."""
    return Master("rosgraph", master_uri).is_online()
