"""Machines that nodes are assigned to; only this one is supported."""

from __future__ import annotations

import ipaddress
import socket

from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.plan import LaunchPlan


def is_local(address: str) -> bool:
    """Return whether a name or address means this machine."""
    if address in {"", "localhost", socket.gethostname()}:
        return True
    try:
        number = ipaddress.ip_address(socket.gethostbyname(address))
    except (OSError, ValueError):
        return False
    if number.is_loopback:
        return True
    # An address of ours is one that we can listen on.
    with socket.socket(socket.AF_INET6 if number.version == 6 else socket.AF_INET) as sock:
        try:
            sock.bind((str(number), 0))
        except OSError:
            return False
    return True


def check(plan: LaunchPlan) -> None:
    """Check that all nodes can run here.

    Raises:
        LaunchError: One is meant for another machine, or for one that is not declared.
    """
    for node in plan.nodes:
        if not node.machine:
            continue
        machine = plan.machines.get(node.machine)
        if machine is None:
            raise LaunchError(
                f"there is no machine '{node.machine}'",
                hint=did_you_mean(node.machine, plan.machines),
                source=node.place,
            )
        if not is_local(machine.address):
            raise LaunchError(
                f"the machine '{machine.name}' is {machine.address}, not this one",
                hint="start the launch file there; nodes are started on this machine only",
                source=node.place,
            )
