"""Joystick: the gamepad of a browser as ``joy_node`` would publish it."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Mapping
from typing import Any

from gazelle.errors import Error
from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.time import Time

_NONE = "No gamepad: connect one to this machine's browser, and press one of its buttons."
_LATE_S = 0.6
"""Without a message of the page for so long, all axes and buttons are released [s]."""
_MOST = 64
_DEAD = 0.05
_REQUEST = "gamepad"

# Gamepads of the standard layout get the order of joy_node for an Xbox controller.
_PAD = """
<img alt="" style="display:none" src="data:," onerror="if(window.gazellePad)return;let was='',at=0;
 const order=p=>{const b=p.buttons.map(e=>e.value);if(p.mapping!='standard')
   return [p.axes.map(e=>-e),b.map(e=>e>0.5?1:0)];
  const a=p.axes,k=i=>b[i]>0.5?1:0;
  return [[-a[0],-a[1],1-2*b[6],-a[2],-a[3],1-2*b[7],k(14)-k(15),k(12)-k(13)],
   [0,1,2,3,4,5,8,9,16,10,11].map(k)]};
 window.gazellePad=setInterval(()=>{const p=[...navigator.getGamepads()].find(e=>e);if(!p)return;
  const [a,b]=order(p),now=a.map(e=>e.toFixed(4)).join()+'&buttons='+b.join(),t=Date.now();
  if(now==was&&t-at<200)return;was=now;at=t;
  fetch('gamepad?name='+encodeURIComponent(p.id)+'&axes='+now).catch(()=>0)},40)">
"""


class JoystickPanel(GraphPanel):
    """Publishes ``sensor_msgs/Joy`` while a gamepad is connected, and all released at the end.

    Args:
        context: Of the page.
    """

    title = "Joystick"
    period = 0.1

    def __init__(self, context: GraphContext) -> None:
        super().__init__(context)
        self._publisher: Any = None
        self._lock = threading.Lock()
        self._name = ""
        self._until = math.inf
        self._released: Any = None

    def build(self) -> None:
        """Add topic and state."""
        gui = self.context.gui
        self._topic: Any = gui.add_text("Topic", "/joy")
        self._state: Any = gui.add_markdown(_NONE)
        gui.add_html(_PAD)
        self.context.on_user_change(self._topic, self._advertise)
        self.inputs = {"topic": self._topic}
        self._advertise()
        self.context.server.handlers[_REQUEST] = self._take

    def refresh(self) -> None:
        """Show which gamepad there is; release all where the page is silent."""
        with self._lock:
            late = time.monotonic() > self._until
            name = "" if late else self._name
        if late:
            self._release()
        text = f"**{name}**" if name else _NONE
        if self._state.content != text:
            self._state.content = text

    def pause(self) -> None:
        """Release all: no page is open."""
        self._release()

    def close(self) -> None:
        """Release all, and leave the topic."""
        self.context.server.handlers.pop(_REQUEST, None)
        self._release()
        self._withdraw()

    def _take(self, query: Mapping[str, str]) -> None:
        """Publish what the page says; on the server's thread."""
        try:
            axes = [_axis(each) for each in query.get("axes", "").split(",") if each][:_MOST]
            pressed = query.get("buttons", "").split(",")
            buttons = [int(each == "1") for each in pressed if each][:_MOST]
        except ValueError:
            return
        with self._lock:
            self._name = _plain(query.get("name", ""))
            self._until = time.monotonic() + _LATE_S
            self._released = [0.0] * len(axes), [0] * len(buttons)
            self._send(axes, buttons)

    def _release(self) -> None:
        with self._lock:
            released, self._released, self._until = self._released, None, math.inf
            self._name = ""
            if released is not None:
                self._send(*released)

    def _send(self, axes: list[float], buttons: list[int]) -> None:
        if self._publisher is not None:
            message = sensor_msgs.msg.Joy(axes=axes, buttons=buttons)
            message.header.stamp = Time(nsecs=self.context.node.clock.now())
            self._publisher.publish(message)

    def _advertise(self) -> None:
        """Publish on the topic of the text."""
        self._withdraw()
        if not self._topic.value:
            raise Error("a joystick is published on a topic", hint="such as /joy")
        kind = sensor_msgs.msg.Joy
        made = self.context.node.advertise(self._topic.value, kind, 1)
        with self._lock:
            self._publisher = made

    def _withdraw(self) -> None:
        with self._lock:
            before, self._publisher = self._publisher, None
        if before is not None:
            before.close()


def _axis(text: str) -> float:
    """Return an axis, 0 in the dead zone and from there on linear to 1, as ``joy_node`` has it.

    Raises:
        ValueError: It is no finite number.
    """
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(text)
    beyond = max(min(abs(value), 1.0) - _DEAD, 0.0) / (1.0 - _DEAD)
    return math.copysign(beyond, value) if beyond else 0.0


def _plain(name: str) -> str:
    """Return the name of a gamepad without marks of Markdown."""
    return "".join(each for each in name if each.isalnum() or each in " .-()")[:80].strip()
