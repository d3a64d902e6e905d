"""The node ``joy_teleop.py``: commands for the buttons of a joystick (http://wiki.ros.org/joy_teleop)."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from typing import Any

from gazelle_ros.base.errors import Error, RosError, did_you_mean
from gazelle_ros.builtin.arguments import CallbackWork, run_node
from gazelle_ros.builtin.joysticks.commands import (
    ButtonCommand,
    ButtonMatch,
    TopicCommand,
    action_command,
    service_command,
)
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.node import Node

_LOG = logging.getLogger("gazelle.ros.joy")
_KINDS = {"topic": TopicCommand, "action": action_command, "service": service_command}
_KEYS = {
    "topic": ("topic_name", "message_type", "deadman_buttons", "axis_mappings", "message_value"),
    "action": ("action_name", "action_goal", "buttons"),
    "service": ("service_name", "service_request", "service_persistent", "buttons"),
}


class JoyTeleop(CallbackWork):
    """Commands of the parameter ``teleop``, run by a joystick's buttons.

    Args:
        node: On the graph.

    Raises:
        RosError: There is no such parameter.
    """

    def __init__(self, node: Node) -> None:
        super().__init__(node)
        where = node.resolve("teleop")
        given = node.get_param(where, None)
        if not isinstance(given, Mapping) or not given:
            raise RosError(f"the parameter {where} has no commands")
        self.commands: list[ButtonCommand] = []
        for name, each in given.items():
            try:
                self.commands.append(_command(node, name, each))
            except Error as error:
                # As by the original: the other commands work.
                _LOG.error("the command '%s' is left out: %s", name, error)
        self._last: list[int] = []
        node.subscribe("joy", sensor_msgs.msg.Joy, self._take)

    def _take(self, joy: sensor_msgs.msg.Joy) -> None:
        pressed = [int(each) for each in joy.buttons]
        changed = pressed != self._last
        self._last = pressed
        for each in self.commands:
            if each.match.fits(pressed):
                each.run(joy, changed=changed)


def main(arguments: Sequence[str]) -> int:
    """Run commands until shutdown; returns the exit code."""
    return run_node(arguments, "joy_teleop", JoyTeleop)


def _command(node: Node, name: str, parameters: Any) -> ButtonCommand:
    if not isinstance(parameters, Mapping):
        raise RosError(f"it must be a mapping of names to values, not {parameters!r:.60}")
    kind = str(parameters.get("type", ""))
    if kind not in _KINDS:
        raise RosError(f"its type is '{kind}'", hint=did_you_mean(kind, _KINDS))
    known = ("type", "allow_multiple_commands", *_KEYS[kind])
    for key in parameters:
        if key not in known:
            _LOG.warning(
                "the command '%s' has an unknown '%s'; %s", name, key, did_you_mean(key, known)
            )
    buttons = (
        parameters.get("deadman_buttons", []) if kind == "topic" else parameters.get("buttons")
    )
    if not isinstance(buttons, list) or any(type(each) is not int for each in buttons):
        raise RosError(f"its buttons must be a list of numbers, not {buttons!r:.60}")
    match = ButtonMatch(buttons, bool(parameters.get("allow_multiple_commands", True)))
    return _KINDS[kind](node, name, match, parameters)
