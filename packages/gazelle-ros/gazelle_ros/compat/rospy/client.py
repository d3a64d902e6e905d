"""Beginning, waiting, and what else a script asks of rospy."""

from __future__ import annotations

import logging
import os
import random
import sys
import threading
import time
from collections.abc import Callable, Iterable
from typing import Any

from gazelle_ros import names as graph_names
from gazelle_ros import time as values
from gazelle_ros.base.deadlines import deadline_after
from gazelle_ros.base.program import program_name
from gazelle_ros.compat.rospy import logs, names
from gazelle_ros.compat.rospy.exceptions import (
    ROSException,
    ROSInitException,
    ROSInterruptException,
)
from gazelle_ros.compat.rospy.guest import master_uri, user
from gazelle_ros.compat.rospy.logs import DEBUG, ERROR, FATAL, INFO, WARN
from gazelle_ros.compat.rospy.msproxy import MasterProxy
from gazelle_ros.compat.rospy.params import (
    delete_param,
    get_param,
    get_param_cached,
    get_param_names,
    has_param,
    search_param,
    set_param,
)
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.compat.rospy.topics import Subscriber
from gazelle_ros.errors import (
    InvalidNameError,
    MasterUnreachableError,
    NoMasterError,
    RosError,
)
from gazelle_ros.msgs import roscpp
from gazelle_ros.node import Node
from gazelle_ros.parameters import set_private

__all__ = [
    "DEBUG",
    "ERROR",
    "FATAL",
    "INFO",
    "WARN",
    "delete_param",
    "get_master",
    "get_param",
    "get_param_cached",
    "get_param_names",
    "get_published_topics",
    "has_param",
    "init_node",
    "myargv",
    "on_shutdown",
    "search_param",
    "set_param",
    "spin",
    "wait_for_message",
]

_LEVELS = {"DEBUG": 10, "INFO": 20, "WARN": 30, "ERROR": 40, "FATAL": 50}
_MASTER_POLL_S = 0.2
_begun: tuple[Any, ...] | None = None
_begin_lock = threading.RLock()


def init_node(
    name: str,
    argv: list[str] | None = None,
    anonymous: bool = False,  # noqa: FBT001, FBT002  # rospy's interface
    log_level: int | None = None,
    disable_rostime: bool = False,  # noqa: FBT001, FBT002
    disable_rosout: bool = False,  # noqa: FBT001, FBT002
    disable_signals: bool = False,  # noqa: FBT001, FBT002
    xmlrpc_port: int = 0,
    tcpros_port: int = 0,
) -> None:
    """Initialise this process as a node; waits for a master.

    Args:
        name: Of the node, without namespace; ``__name:=`` on the command line wins.
        argv: The command line, by default this process's.
        anonymous: Append process and time, so that many may run.
        log_level: `DEBUG` to `FATAL`.
        disable_rostime: Go by the time of the machine, whatever ``/use_sim_time`` says.
        disable_rosout: Do not log to /rosout.
        disable_signals: Leave Ctrl-C to the script.
        xmlrpc_port: Accepted; a free port is used.
        tcpros_port: Accepted; a free port is used.

    Raises:
        ValueError: The name is empty or has a namespace.
        ROSException: The node was begun before, with other arguments.
        ROSInitException: There is no master.
    """
    global _begun  # noqa: PLW0603  # there is one node a process
    del xmlrpc_port, tcpros_port
    if argv is not None:
        names.reload_mappings(argv)
    if not name:
        raise ValueError("name must not be empty")
    if graph_names.SEPARATOR in name:
        raise ValueError("namespaces are not allowed in node names")
    arguments = (name, argv, anonymous, log_level, disable_rostime, disable_signals)
    with _begin_lock:
        if _begun is not None:
            if _begun != arguments:
                raise ROSException(
                    f"rospy.init_node() has already been called with different arguments: {_begun}"
                )
            return
        _begin(name, anonymous=anonymous, wall=disable_rostime)
        _begun = arguments
    if not disable_signals and threading.current_thread() is threading.main_thread():
        process.catch_signals()
    logs.start_screen(log_level)
    process.start()
    if not disable_rosout:
        logs.start_rosout()
        _serve_logger_levels()
    set_private(process.require().parameters, names.identity.assigned)


def _begin(name: str, *, anonymous: bool, wall: bool) -> None:
    """Make the node."""
    from gazelle_ros.clock import WallClock

    mappings = names.get_mappings()
    if mappings.get("__name"):
        name, anonymous = mappings["__name"], False
    if not graph_names.is_legal_base(name):
        sys.stderr.write(
            f"WARNING: '{name}' is not a legal ROS base name. This may cause problems with other "
            "ROS tools.\n"
        )
    try:
        node = _join(
            name,
            namespace=names.get_namespace(),
            master_uri=master_uri(),
            host=mappings.get("__hostname") or mappings.get("__ip"),
            anonymous=anonymous,
            remappings=mappings,
            clock=WallClock() if wall else None,
            # A script may change a message after it published it.
            share_messages=False,
        )
    except InvalidNameError as error:
        raise ROSInitException(str(error)) from error
    except RosError as error:
        raise ROSInitException(f"init_node failed: {error}") from None
    process.adopt(node)
    names._set_caller_id(node.name)  # noqa: SLF001  # a module of the same package
    names.initialize_mappings(node.name)
    # Processes that begin together shall not make the same random names.
    random.seed(os.urandom(16))


def _join(name: str, **options: Any) -> Node:
    """Return the node, as soon as there is a master, which scripts may have started just now.

    Raises:
        RosError: It cannot be made, or what is there is no master.
    """
    said = False
    while True:
        try:
            return Node(name, **options)
        except NoMasterError:
            raise
        except MasterUnreachableError:
            if not said:
                said = True
                sys.stdout.write(
                    f"Unable to register with master node [{options['master_uri']}]: master may "
                    f"not be running yet. Will keep trying. ('{program_name()} master' starts one.)\n"
                )
                sys.stdout.flush()
        time.sleep(_MASTER_POLL_S)


def _serve_logger_levels() -> None:
    node = process.require()
    logger = roscpp.msg.Logger
    get, change = roscpp.srv.GetLoggers, roscpp.srv.SetLoggerLevel

    def loggers(_request: roscpp.srv.GetLoggersRequest) -> roscpp.srv.GetLoggersResponse:
        response = roscpp.srv.GetLoggersResponse()
        known = ["rosout", *sorted(n for n in logging.root.manager.loggerDict if "rosout." in n)]
        response.loggers = [
            logger(name, logging.getLevelName(logging.getLogger(name).getEffectiveLevel()))
            for name in known
        ]
        return response

    def set_level(request: roscpp.srv.SetLoggerLevelRequest) -> Any:
        level = _LEVELS.get(request.level.upper())
        if level is None:
            raise ROSException(f"no such level: {request.level}")
        logging.getLogger(request.logger).setLevel(level)
        return change._response_class()

    node.serve("~get_loggers", get, loggers)
    node.serve("~set_logger_level", change, set_level)


def spin() -> None:
    """Wait for the end of the node.

    Raises:
        ROSInitException: There is no node.
    """
    process.require()
    try:
        while not process.shutdown.wait(0.5):
            pass
    except KeyboardInterrupt:
        process.end("keyboard interrupt")
    process.wait_ended()


def on_shutdown(h: Callable[[], Any]) -> None:
    """Call a function when the node ends, while it can still publish."""
    process.clients.append(h)


def myargv(argv: Iterable[str] | None = None) -> list[str]:
    """Return the command line without remappings."""
    return [each for each in (sys.argv if argv is None else argv) if graph_names.REMAP not in each]


def get_published_topics(namespace: str = "/") -> list[list[str]]:
    """Return name and type of each topic that has a publisher.

    Raises:
        ROSException: The master refuses.
    """
    code, text, found = user().master.call_raw("getPublishedTopics", namespace)
    if code != 1:
        raise ROSException(f"unable to get published topics: {text}")
    return [list(each) for each in found]


def get_master(env: Any = None) -> MasterProxy:
    """Return the master; see `MasterProxy`."""
    del env
    return MasterProxy(master_uri())


def wait_for_message(
    topic: str, topic_type: Any, timeout: values.Duration | float | None = None
) -> Any:
    """Return the next message of a topic.

    Args:
        topic: Its name.
        topic_type: Class of the messages.
        timeout: The longest wait [s of wall time], or a duration.

    Raises:
        ROSException: None came in time.
        ROSInterruptException: The node was shut down meanwhile.
    """
    found: list[Any] = []
    came = threading.Event()

    def keep(message: Any) -> None:
        found.append(message)
        came.set()

    seconds = timeout.to_sec() if isinstance(timeout, values.Duration) else timeout
    deadline = None if seconds is None else deadline_after(seconds)
    subscriber = Subscriber(topic, topic_type, keep)
    try:
        while not process.over:
            left = 0.2 if deadline is None else min(0.2, deadline - time.monotonic())
            if came.wait(max(0.0, left)):
                return found[0]
            if deadline is not None and time.monotonic() >= deadline:
                raise ROSException(f"timeout exceeded while waiting for message on topic {topic}")
    finally:
        subscriber.unregister()
    process.wait_ended()
    raise ROSInterruptException("rospy shutdown")


def reset() -> None:
    """Close the node and discard it, so that `init_node` may be called again in this process."""
    global _begun  # noqa: PLW0603  # there is one node a process
    process.end("reset")
    process.reset()
    logs.stop()
    names.reload_mappings(sys.argv)
    _begun = None
