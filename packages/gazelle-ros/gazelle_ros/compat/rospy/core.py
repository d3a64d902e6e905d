"""Functions that scripts use from ``rospy.core``: state, shutdown, logging."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from typing import Any
from urllib.parse import urlparse

from gazelle_ros.compat.rospy import logs
from gazelle_ros.compat.rospy.exceptions import ROSException, ROSInitException
from gazelle_ros.compat.rospy.logs import *  # noqa: F403  levels and functions, listed there
from gazelle_ros.compat.rospy.names import (
    SERVICE_ANYTYPE,
    TOPIC_ANYTYPE,
    get_caller_id,
    get_name,
    get_namespace,
    resolve_name,
)
from gazelle_ros.compat.rospy.state import process

__all__ = [
    "ROSRPC",
    "SERVICE_ANYTYPE",
    "TOPIC_ANYTYPE",
    "ROSException",
    "ROSInitException",
    "add_client_shutdown_hook",
    "add_preshutdown_hook",
    "add_shutdown_hook",
    "get_caller_id",
    "get_name",
    "get_namespace",
    "get_node_uri",
    "get_ros_root",
    "is_initialized",
    "is_shutdown",
    "is_shutdown_requested",
    "parse_rosrpc_uri",
    "resolve_name",
    "rospydebug",
    "rospyerr",
    "rospyinfo",
    "rospywarn",
    "set_initialized",
    "signal_shutdown",
    "xmlrpcapi",
]
__all__ += logs.__all__

ROSRPC = "rosrpc://"
rospydebug, rospyinfo = logs.logdebug, logs.loginfo
rospywarn, rospyerr = logs.logwarn, logs.logerr


def is_initialized() -> bool:
    """Return whether `init_node` was called."""
    return process.ready.is_set()


def set_initialized(initialized: bool) -> None:  # noqa: FBT001  # rospy's interface
    """Set whether the node runs."""
    if initialized:
        process.ready.set()
    else:
        process.ready.clear()


def is_shutdown() -> bool:
    """Return whether the node ended, or is about to; not yet for the hooks of `on_shutdown`."""
    return process.over


def is_shutdown_requested() -> bool:
    """Return whether the node ended, or is about to."""
    return process.shutdown.is_set()


def signal_shutdown(reason: str) -> None:
    """Shut the node down."""
    process.end(reason)
    process.wait_ended()


def add_preshutdown_hook(h: Callable[[str], Any]) -> None:
    """Call a function with the reason, first of all, when the node ends."""
    _check_hook(h)
    process.before.append(h)


def add_client_shutdown_hook(h: Callable[[], Any]) -> None:
    """Call a function when the node ends."""
    _check_hook(h)
    process.clients.append(h)


def add_shutdown_hook(h: Callable[[str], Any]) -> None:
    """Call a function with the reason, after the others, when the node ends."""
    _check_hook(h)
    process.after.append(h)


def _check_hook(h: Any) -> None:
    if not callable(h):
        raise TypeError(f"shutdown hook [{h}] must be a function: {type(h)}")


def get_node_uri() -> str | None:
    """Return the URI of the node's XML-RPC server; None before `init_node`."""
    return None if process.node is None else process.node.uri


def get_ros_root(required: bool = False, env: Any = None) -> Any:  # noqa: FBT001, FBT002  # rospy's interface
    """Return the value of ROS_ROOT.

    Raises:
        ROSException: It is required and not set.
    """
    root = (os.environ if env is None else env).get("ROS_ROOT")
    if required and not root:
        raise ROSException("The ROS_ROOT environment variable has not been set")
    return root


def parse_rosrpc_uri(uri: str) -> tuple[str, int]:
    """Parse host and port of a service's address.

    Raises:
        ValueError: It is none.
    """
    parts = urlparse(uri)
    if parts.scheme != "rosrpc" or not parts.hostname or not parts.port:
        raise ValueError(f"Invalid protocol for ROS service URL: {uri}")
    return parts.hostname, parts.port


_servers = threading.local()


def xmlrpcapi(uri: str, cache: bool = True) -> Any:  # noqa: FBT001, FBT002  # rospy's interface
    """Return the XML-RPC API at an address; None for an address that is none."""
    import xmlrpc.client

    if not uri or not urlparse(uri).netloc:
        return None
    known: dict[str, Any] = _servers.__dict__.setdefault("known", {})
    if cache and uri in known:
        return known[uri]
    server = xmlrpc.client.ServerProxy(uri)
    if cache:
        known[uri] = server
    return server
