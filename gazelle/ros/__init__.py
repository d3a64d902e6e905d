"""ROS 1 without ROS: master, nodes, messages, exact on the wire; usable without a simulation.

::

    import gazelle.ros as ros

    with ros.Master(port=0) as master, ros.Node("talker", master_uri=master.uri) as node:
        publisher = node.advertise("chatter", ros.load_message("std_msgs/String"))

Nothing is imported until it is used.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gazelle.ros.clock import Rate, SimulatedClock, WallClock
    from gazelle.ros.compat import install, uninstall
    from gazelle.ros.master.proxy import MasterProxy
    from gazelle.ros.master.server import Master, run_master
    from gazelle.ros.messages import load_message, load_service
    from gazelle.ros.node import Node
    from gazelle.ros.publishing import Publisher
    from gazelle.ros.raw import RawMessage
    from gazelle.ros.services import ServiceClient, ServiceServer
    from gazelle.ros.subscribing import Subscriber
    from gazelle.ros.time import Duration, Time

_HOMES = {
    "Duration": "gazelle.ros.time",
    "Master": "gazelle.ros.master.server",
    "MasterProxy": "gazelle.ros.master.proxy",
    "Node": "gazelle.ros.node",
    "Publisher": "gazelle.ros.publishing",
    "Rate": "gazelle.ros.clock",
    "RawMessage": "gazelle.ros.raw",
    "ServiceClient": "gazelle.ros.services",
    "ServiceServer": "gazelle.ros.services",
    "SimulatedClock": "gazelle.ros.clock",
    "Subscriber": "gazelle.ros.subscribing",
    "Time": "gazelle.ros.time",
    "WallClock": "gazelle.ros.clock",
    "install": "gazelle.ros.compat",
    "load_message": "gazelle.ros.messages",
    "load_service": "gazelle.ros.messages",
    "run_master": "gazelle.ros.master.server",
    "uninstall": "gazelle.ros.compat",
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
    raise AttributeError(f"module 'gazelle.ros' has no attribute '{name}'")


def __dir__() -> list[str]:
    return __all__
