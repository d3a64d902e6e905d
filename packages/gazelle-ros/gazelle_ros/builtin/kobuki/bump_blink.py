"""The nodelet ``kobuki_controller_tutorial``: a light while a bumper is pressed (http://wiki.ros.org/kobuki_controller_tutorial)."""

from __future__ import annotations

from gazelle_ros.builtin.arguments import CallbackWork
from gazelle_ros.builtin.parameters import warn_of_others
from gazelle_ros.builtin.switching import EnableSwitch
from gazelle_ros.msgs import kobuki_msgs
from gazelle_ros.node import Node

_BUMPER, _LED = kobuki_msgs.msg.BumperEvent, kobuki_msgs.msg.Led
_QUEUE = 10


class BumpBlink(CallbackWork):
    """Green on ``~commands/led1`` when a bumper is pressed, dark when it is released.

    It is disabled at first, as in the original: a message on ``~enable`` begins it.

    Args:
        node: On the graph, with ``~events/bumper``.
    """

    def __init__(self, node: Node) -> None:
        super().__init__(node)
        warn_of_others(node, ())
        self.switch = EnableSwitch(node, on=False)
        self._light = node.advertise("~commands/led1", _LED, queue_size=_QUEUE)
        node.subscribe("~events/bumper", _BUMPER, self._take, _QUEUE)

    def _take(self, message: kobuki_msgs.msg.BumperEvent) -> None:
        if self.switch.on:
            pressed = message.state == _BUMPER.PRESSED
            self._light.publish(_LED(value=_LED.GREEN if pressed else _LED.BLACK))
