"""rosgraph's interface: the master, names, addresses."""

from __future__ import annotations

import sys
from collections.abc import Iterable

from gazelle_ros.compat.rosgraph import masterapi, names, network, rosenv, roslogging, xmlrpc
from gazelle_ros.compat.rosgraph.masterapi import (
    Master,
    MasterError,
    MasterException,
    MasterFailure,
)
from gazelle_ros.compat.rosgraph.masterapi import is_online as is_master_online
from gazelle_ros.compat.rosgraph.rosenv import (
    ROS_HOSTNAME,
    ROS_IP,
    ROS_IPV6,
    ROS_MASTER_URI,
    ROS_NAMESPACE,
    get_master_uri,
)

__all__ = [
    "ROS_HOSTNAME",
    "ROS_IP",
    "ROS_IPV6",
    "ROS_MASTER_URI",
    "ROS_NAMESPACE",
    "Master",
    "MasterError",
    "MasterException",
    "MasterFailure",
    "get_master_uri",
    "is_master_online",
    "masterapi",
    "myargv",
    "names",
    "network",
    "rosenv",
    "roslogging",
    "xmlrpc",
]


def myargv(argv: Iterable[str] | None = None) -> list[str]:
    """Return the command line without remappings."""
    return [each for each in (sys.argv if argv is None else argv) if names.REMAP not in each]
