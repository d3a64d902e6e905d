"""``controller_manager``: load, start, stop and list controllers from a command line."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence

from gazelle_ros.compat import rospy
from gazelle_ros.compat.controller_manager import controller_manager_interface as manager

_USAGE = """Commands:
    load NAME...                   load controllers
    unload NAME...                 unload controllers
    start NAME...                  start controllers
    stop NAME...                   stop controllers
    spawn NAME...                  load and start controllers
    kill NAME...                   stop and unload controllers
    list                           list what is loaded
    list-types                     list the types that can be loaded
    reload-libraries [--restore]   load the code of all controllers again
"""
_SHORT = {"sp": "spawn", "kl": "kill", "lc": "list", "lt": "list-types"}
_OF_NAMES: dict[str, tuple[Callable[[str], bool], ...]] = {
    "load": (manager.load_controller,),
    "unload": (manager.unload_controller,),
    "start": (manager.start_controller,),
    "stop": (manager.stop_controller,),
    "spawn": (manager.load_controller, manager.start_controller),
    "kill": (manager.stop_controller, manager.unload_controller),
}


def main(arguments: Sequence[str]) -> int:
    """Run the sub-command; returns the exit code."""
    words = begin_node("controller_manager", arguments)
    command = _SHORT.get(words[0], words[0]) if words else ""
    try:
        if command in _OF_NAMES:
            for act in _OF_NAMES[command]:
                for name in words[1:]:
                    act(name)
        elif command == "list":
            manager.list_controllers()
        elif command == "list-types":
            manager.list_controller_types()
        elif command == "reload-libraries":
            manager.reload_libraries(force_kill=True, restore="--restore" in words[1:])
        else:
            sys.stdout.write(_USAGE)
            return 1 if words else 0
    except rospy.ROSInterruptException:
        return 0
    return 0


def begin_node(name: str, arguments: Sequence[str]) -> list[str]:
    """Start a node with a unique name; returns its own arguments."""
    sys.argv = [name, *arguments]
    rospy.init_node(name, argv=sys.argv, anonymous=True)
    return rospy.myargv()[1:]
