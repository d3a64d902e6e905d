"""``unspawner``: keep controllers stopped until it ends."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

from gazelle_ros import names
from gazelle_ros.builtin.controllers.command import begin_node
from gazelle_ros.compat import rospy
from gazelle_ros.messages import load_service

_BEST_EFFORT = 1
_AGAIN_S = 3
_USAGE = """unspawner NAME...

Stops controllers, and starts those again that it stopped when it ends.
"""


def main(arguments: Sequence[str]) -> int:
    """Keep controllers stopped; returns the exit code."""
    if not names.split_arguments(arguments)[0] or {"-h", "--help"} & set(arguments):
        sys.stdout.write(_USAGE)
        return 1
    unwanted = set(begin_node("unspawner", arguments))
    switch, listing = _proxy("switch_controller"), _proxy("list_controllers")
    stopped: dict[str, None] = {}

    def stop(_event: object = None) -> None:
        running = [each.name for each in listing().controller if each.state == "running"]
        found = [name for name in running if name in unwanted]
        if found:
            rospy.loginfo(f"Inhibiting controllers: {', '.join(found)}")
            switch(strictness=_BEST_EFFORT, stop_controllers=found)
            stopped.update(dict.fromkeys(found))

    def start() -> None:
        timer.shutdown()
        switch(strictness=_BEST_EFFORT, start_controllers=list(stopped))

    switch.wait_for_service()
    listing.wait_for_service()
    stop()
    timer = rospy.Timer(rospy.Duration(_AGAIN_S), stop)
    rospy.on_shutdown(start)
    rospy.spin()
    return 0


def _proxy(name: str) -> Any:
    kind = "".join(word.title() for word in name.split("_"))
    service = load_service(f"controller_manager_msgs/{kind}")
    return rospy.ServiceProxy(f"controller_manager/{name}", service)
