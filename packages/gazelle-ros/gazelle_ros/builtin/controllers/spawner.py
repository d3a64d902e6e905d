"""``spawner``: load and start controllers, and take them down again at the end."""

from __future__ import annotations

import argparse
import sys
import threading
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from gazelle_ros import names
from gazelle_ros.builtin.controllers.command import begin_node
from gazelle_ros.compat import rosparam, rospy
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.values import load_yaml
from gazelle_ros.messages import load_service
from gazelle_ros.msgs import std_msgs

_STRICT = 2
_LOOK_S = 0.05
_ANSWERED = "responded with an error"


def main(arguments: Sequence[str]) -> int:
    """Load, start, wait for the end, stop and unload; returns the exit code."""
    options = _parse(names.split_arguments(arguments)[0])
    begin_node("spawner", arguments)
    if options.shutdown_timeout is not None:
        rospy.logwarn("DEPRECATION warning: --shutdown-timeout has no effect.")
    unlimited = options.no_timeout or options.timeout <= 0
    timeout = None if unlimited else options.timeout
    spawner = Spawner(options.namespace or "")
    if not spawner.find_manager(timeout):
        return 0
    if options.wait_for and not _wait_for(options.wait_for, timeout):
        return 0
    rospy.on_shutdown(spawner.take_down)
    spawner.load([name for word in options.controllers for name in _controllers_of(word)])
    if not options.stopped and not rospy.is_shutdown():
        spawner.start()
    rospy.spin()
    return 0


def _parse(words: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="spawner", description="Load and start controllers.")
    parser.add_argument("--stopped", action="store_true", help="load them, but do not start them")
    parser.add_argument("--wait-for", metavar="TOPIC", help="until this Bool is true")
    parser.add_argument("--namespace", metavar="NS", help="of the manager; that of the node")
    parser.add_argument(
        "--timeout", type=float, default=30.0, help="for the manager [s]; 0 waits for ever"
    )
    parser.add_argument("--no-timeout", action="store_true", help="the same as --timeout 0")
    parser.add_argument("--shutdown-timeout", help="DEPRECATED: it has no effect")
    parser.add_argument("controllers", nargs="+", help="names, or YAML files with them")
    return parser.parse_args(words)


class Spawner:
    """Calls a manager for some controllers.

    Args:
        namespace: Of the manager; relative to the node's.

    Attributes:
        loaded: Names of the controllers that it loaded.
    """

    def __init__(self, namespace: str) -> None:
        space = f"{namespace}/" if namespace and not namespace.endswith("/") else namespace
        self._manager = f"{space}controller_manager"
        self.loaded: list[str] = []

    def find_manager(self, timeout: float | None) -> bool:
        """Wait until there is the manager, and for as long as there is no time yet.

        Args:
            timeout: For each of its services [s of wall time]; None for ever.

        Returns:
            Whether it is there.
        """
        while not rospy.is_shutdown():
            try:
                for name in ("load_controller", "switch_controller", "unload_controller"):
                    rospy.loginfo(f"Controller Spawner: Waiting for service {self._manager}/{name}")
                    rospy.wait_for_service(f"{self._manager}/{name}", timeout=timeout)
            except rospy.ROSInterruptException:
                break
            except rospy.ROSException:
                if rospy.get_param("/use_sim_time", False) and rospy.get_rostime().is_zero():
                    rospy.loginfo("Waiting for /clock to be available...")
                    continue
                rospy.logwarn(
                    "Controller Spawner couldn't find the expected controller_manager ROS interface."
                )
                break
            else:
                return True
        return False

    def load(self, controllers: Sequence[str]) -> None:
        """Load controllers, as many as can be."""
        for name in controllers:
            rospy.loginfo(f"Loading controller: {name}")
            if self._call("load_controller", "LoadController", name=name):
                self.loaded.append(name)
            else:
                rospy.logerr(f"Failed to load {name}")
        rospy.loginfo(f"Controller Spawner: Loaded controllers: {', '.join(self.loaded)}")

    def start(self) -> None:
        """Start the loaded controllers, all or none."""
        if self._switch(start_controllers=self.loaded):
            rospy.loginfo(f"Started controllers: {', '.join(self.loaded)}")
        else:
            rospy.logerr(f"Failed to start controllers: {', '.join(self.loaded)}")

    def take_down(self) -> None:
        """Stop and unload the loaded controllers in reverse order."""
        rospy.loginfo("Shutting down spawner. Stopping and unloading controllers...")
        try:
            rospy.loginfo("Stopping all controllers...")
            self._switch(stop_controllers=self.loaded)
            rospy.loginfo("Unloading all loaded controllers...")
            for name in reversed(self.loaded):
                rospy.loginfo(f"Trying to unload {name}")
                if self._call("unload_controller", "UnloadController", name=name):
                    rospy.loginfo(f"Succeeded in unloading {name}")
        except (rospy.ServiceException, rospy.ROSException) as error:
            if _ANSWERED not in str(error):
                # As at the end of a launch, where all are asked to end at once.
                rospy.loginfo("The controller manager is gone, and its controllers with it.")
                return
            rospy.logwarn(f"Controller Spawner error while taking down controllers: {error}")

    def _switch(self, **lists: Sequence[str]) -> bool:
        return self._call("switch_controller", "SwitchController", strictness=_STRICT, **lists)

    def _call(self, name: str, kind: str, /, **fields: Any) -> bool:
        service = load_service(f"controller_manager_msgs/{kind}")
        proxy = rospy.ServiceProxy(f"{self._manager}/{name}", service)
        return bool(proxy(service._request_class(**fields)).ok)


def _controllers_of(word: str) -> list[str]:
    """Return the controllers of a word of the command line: itself, or those of a YAML file.

    The file's parameters are set first, in the namespace of the node.
    """
    if not Path(word).is_file():
        return [word]
    try:
        values = load_yaml(Path(word).read_text(encoding="utf-8"))
    except (OSError, LaunchError, UnicodeDecodeError) as error:
        rospy.logerr(f"Failed to read {word}: {error}")
        return []
    if not isinstance(values, dict):
        rospy.logerr(f"Failed to read {word}: it has no controllers, by name")
        return []
    rosparam.set_param_raw(rospy.get_namespace(), values)
    return [str(name) for name in values]


def _wait_for(topic: str, timeout: float | None) -> bool:
    """Wait until a topic says true, for ever if need be; returns whether it did."""
    received, true = threading.Event(), threading.Event()

    def receive(message: std_msgs.msg.Bool) -> None:
        received.set()
        if message.data:
            true.set()

    subscriber = rospy.Subscriber(topic, std_msgs.msg.Bool, receive)
    reminder = threading.Timer(timeout, _remind, (topic, received)) if timeout else None
    if reminder is not None:
        reminder.daemon = True
        reminder.start()
    try:
        while not true.wait(_LOOK_S):
            if rospy.is_shutdown():
                return False
    finally:
        if reminder is not None:
            reminder.cancel()
        subscriber.unregister()
    return True


def _remind(topic: str, received: threading.Event) -> None:
    if not received.is_set():
        rospy.logwarn(
            f'Controller Spawner hasn\'t heard anything from its "wait for" topic ({topic})'
        )
        sys.stdout.flush()
