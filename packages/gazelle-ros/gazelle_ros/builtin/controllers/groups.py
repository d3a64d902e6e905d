"""``controller_group``: groups of controllers that run together, after the parameter ``controller_groups``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping, Sequence

from gazelle_ros import names
from gazelle_ros.builtin.controllers.command import begin_node
from gazelle_ros.compat import rospy
from gazelle_ros.compat.controller_manager import controller_manager_interface as manager
from gazelle_ros.msgs import controller_manager_msgs

_PARAMETER = "controller_groups"
_TIMEOUT_S = 5.0


def main(arguments: Sequence[str]) -> int:
    """List groups, or start one; returns the exit code."""
    parser = argparse.ArgumentParser(prog="controller_group", description="Groups of controllers.")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    commands.add_parser("list", help="list the groups")
    for command, text in (
        ("spawn", "load and start the controllers of a group"),
        ("switch", "start a group, and stop the controllers of all others"),
    ):
        commands.add_parser(command, help=text).add_argument("group")
    options = parser.parse_args(names.split_arguments(arguments)[0])
    begin_node("controller_group", arguments)
    groups = rospy.get_param(_PARAMETER, {})
    if options.command == "list":
        _list(groups)
        return 0
    controllers = list(dict.fromkeys(groups.get(options.group, ())))
    if not controllers:
        rospy.logerr(f"There is no controller defined in group {options.group}")
    elif options.command == "spawn":
        _spawn(controllers)
    else:
        others = {name for group in groups.values() for name in group} - set(controllers)
        _switch(controllers, others)
    return 0


def _list(groups: Mapping[str, Sequence[str]]) -> None:
    lines = [f"Number of groups: {len(groups)}"]
    for group, controllers in sorted(groups.items()):
        lines += [f"  {group}", *(f"      {name}" for name in controllers)]
    sys.stdout.write("\n".join(lines) + "\n")


def _spawn(controllers: Sequence[str]) -> None:
    for name in controllers:
        manager.load_controller(name)
    for name in controllers:
        manager.start_controller(name)


def _switch(controllers: Sequence[str], others: set[str]) -> None:
    """Load missing controllers, start those of the group, and stop those of other groups."""
    states = _states()
    for name in controllers:
        if name not in states and not manager.load_controller(name):
            sys.stdout.write("Cancel group switching\n")
            return
    manager.start_stop_controllers(
        start_controllers=[name for name in controllers if states.get(name) != "running"],
        stop_controllers=[
            name for name, state in states.items() if name in others and state == "running"
        ],
    )


def _states() -> dict[str, str]:
    """Return the state of each loaded controller."""
    service = "controller_manager/list_controllers"
    rospy.wait_for_service(service, timeout=_TIMEOUT_S)
    proxy = rospy.ServiceProxy(service, controller_manager_msgs.srv.ListControllers)
    return {each.name: each.state for each in proxy().controller}
