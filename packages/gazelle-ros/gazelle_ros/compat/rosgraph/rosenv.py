"""Environment variables."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Mapping

ROS_MASTER_URI = "ROS_MASTER_URI"
ROS_IP = "ROS_IP"
ROS_IPV6 = "ROS_IPV6"
ROS_HOSTNAME = "ROS_HOSTNAME"
ROS_NAMESPACE = "ROS_NAMESPACE"
DEFAULT_MASTER_PORT = 11311
DEFAULT_MASTER_URI = "http://localhost:11311/"


def get_master_uri(env: Mapping[str, str] | None = None, argv: Iterable[str] | None = None) -> str:
    """Return the master's URI: ``__master:=``, else ROS_MASTER_URI, else this machine's port."""
    for argument in sys.argv if argv is None else argv:
        if argument.startswith("__master:="):
            return argument[len("__master:=") :]
    return (os.environ if env is None else env).get(ROS_MASTER_URI) or DEFAULT_MASTER_URI
