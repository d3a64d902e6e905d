"""The graph that the helpers speak to, and how they report."""

from __future__ import annotations

import functools
import threading
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import ParamSpec

from gazelle.clients.controllers import Controllers
from gazelle.clients.gazebo import Gazebo
from gazelle.errors import Error
from gazelle_ros import Node
from gazelle_ros.compat import rospy
from gazelle_ros.compat.rospy.state import process

P = ParamSpec("P")
_PATIENCE_S = 30.0
_RETRIES = 5

_lock = threading.RLock()
_own: list[Node] = []
_clients: dict[Node, Gazebo] = {}


def node() -> Node:
    """Return the script's node; an own one before ``rospy.init_node``."""
    with _lock:
        if process.node is not None and not process.node.closed:
            return process.node
        _own[:] = [each for each in _own if not each.closed]
        if not _own:
            _own.append(Node("frobs_rl", anonymous=True))
        return _own[0]


def gazebo() -> Gazebo:
    """Return the simulator."""
    caller = node()
    with _lock:
        for old in [each for each in _clients if each.closed]:
            del _clients[old]
        if caller not in _clients:
            _clients[caller] = Gazebo(caller, timeout=_PATIENCE_S, retries=_RETRIES)
        return _clients[caller]


def controllers(ns: str | None, retries: int) -> Controllers:
    """Return the controllers of a robot."""
    return Controllers(node(), ns or "/", _PATIENCE_S, retries)


def reporting(action: Callable[P, object]) -> Callable[P, bool]:
    """Wrap a helper so that it returns whether it succeeded; the reason is logged."""

    @functools.wraps(action)
    def report(*args: P.args, **kwargs: P.kwargs) -> bool:
        try:
            action(*args, **kwargs)
        except Error as error:
            log_error(f"{action.__name__}: {error}")
            return False
        return True

    return report


def log_error(text: str) -> None:
    """Log an error, by the node if there is one."""
    rospy.logerr(text)


def xacro_arguments(words: Sequence[str] | None) -> dict[str, str]:
    """Convert ``["name:=value"]`` to values by name."""
    pairs = (word.partition(":=") for word in words or ())
    return {name.strip(): value for name, _, value in pairs}


def in_folder(folder: str, file: str) -> str:
    """Return a file below a folder of a package, such as ``urdf/robot.urdf``."""
    return str(Path(folder.strip("/")) / file)


def parameter(ns: str | None, name: str) -> str:
    """Return the full name of a parameter in a namespace."""
    return "/" + "/".join(filter(None, ((ns or "").strip("/"), name.strip("/"))))
