"""ROS 1 in pure Python: master, nodes, messages, bags and launch files, without a ROS installation.

::

    import gazelle_ros as ros

    with ros.Master(port=0) as master, ros.Node("talker", master_uri=master.uri) as node:
        publisher = node.advertise("chatter", ros.load_message("std_msgs/String"))

Nothing is imported until it is used.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gazelle_ros.clock import Rate, SimulatedClock, WallClock
    from gazelle_ros.compat import install, uninstall
    from gazelle_ros.master.proxy import MasterProxy
    from gazelle_ros.master.server import Master, run_master
    from gazelle_ros.messages import load_message, load_service
    from gazelle_ros.node import Node
    from gazelle_ros.publishing import Publisher
    from gazelle_ros.raw import RawMessage
    from gazelle_ros.services import ServiceClient, ServiceServer
    from gazelle_ros.subscribing import Subscriber
    from gazelle_ros.time import Duration, Time

__version__ = "0.1.0.dev0"

_HOMES = {
    "Duration": "gazelle_ros.time",
    "Master": "gazelle_ros.master.server",
    "MasterProxy": "gazelle_ros.master.proxy",
    "Node": "gazelle_ros.node",
    "Publisher": "gazelle_ros.publishing",
    "Rate": "gazelle_ros.clock",
    "RawMessage": "gazelle_ros.raw",
    "ServiceClient": "gazelle_ros.services",
    "ServiceServer": "gazelle_ros.services",
    "SimulatedClock": "gazelle_ros.clock",
    "Subscriber": "gazelle_ros.subscribing",
    "Time": "gazelle_ros.time",
    "WallClock": "gazelle_ros.clock",
    "install": "gazelle_ros.compat",
    "load_message": "gazelle_ros.messages",
    "load_service": "gazelle_ros.messages",
    "run_master": "gazelle_ros.master.server",
    "uninstall": "gazelle_ros.compat",
}

__all__ = [
    "Duration",
    "Master",
    "MasterProxy",
    "Node",
    "Publisher",
    "Rate",
    "RawMessage",
    "ServiceClient",
    "ServiceServer",
    "SimulatedClock",
    "Subscriber",
    "Time",
    "WallClock",
    "install",
    "load_message",
    "load_service",
    "run_master",
    "uninstall",
]


def __getattr__(name: str) -> Any:
    """Import a public name from its module on first use."""
    if name in _HOMES:
        value = getattr(importlib.import_module(_HOMES[name]), name)
        globals()[name] = value
        return value
    raise AttributeError(f"module 'gazelle_ros' has no attribute '{name}'")


def __dir__() -> list[str]:
    return __all__
