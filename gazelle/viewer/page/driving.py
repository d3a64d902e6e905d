"""Drive a robot from the page: a joystick for the mouse, and keys."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Mapping

from gazelle.simulation.ports import TwistInput
from gazelle.viewer.page.context import PageContext
from gazelle.viewer.page.server import PageServer

_HINT = "Select a robot with wheels or rotors."
_LATE = 0.6  # after which a robot stands still when nothing is received [s]

_STICK = """
<div id="gazelle-stick" tabindex="0" title="drag, or click and use the arrow keys or W A S D"
 style="width:9em;height:9em;margin:0.5em auto;border-radius:50%;background:var(--mantine-color-default-border);position:relative;
 outline-offset:3px;touch-action:none;cursor:grab"
 onpointerdown="this.setPointerCapture(event.pointerId);this.held=1;this.onpointermove(event)"
 onpointermove="if(!this.held)return;const b=this.getBoundingClientRect(),r=b.width/2;
  let x=(event.clientX-b.left-r)/r,y=(b.top+r-event.clientY)/r;const n=Math.max(1,Math.hypot(x,y));
  this.go(y/n,-x/n)"
 onpointerup="this.held=0;this.go(0,0)"
 onkeydown="const k=event.key.toLowerCase();if(!(k in this.ways))return;event.preventDefault();
  event.stopPropagation();this.keys.add(k);this.press()"
 onkeyup="this.keys.delete(event.key.toLowerCase());this.press()"
 onblur="this.keys.clear();this.press()">
 <div style="width:2.4em;height:2.4em;border-radius:50%;background:var(--mantine-primary-color-filled);
  position:absolute;left:3.3em;top:3.3em;pointer-events:none"></div></div>
<img alt="" style="display:none" src="data:," onerror="const s=document.getElementById('gazelle-stick');
 if(s.go)return;s.keys=new Set();s.v=[0,0];
 s.ways={arrowup:[1,0],w:[1,0],arrowdown:[-1,0],s:[-1,0],arrowleft:[0,1],a:[0,1],arrowright:[0,-1],d:[0,-1]};
 s.press=()=>{let f=0,t=0;for(const k of s.keys){f+=s.ways[k][0];t+=s.ways[k][1]}
  s.go(Math.max(-1,Math.min(1,f)),Math.max(-1,Math.min(1,t)))};
 s.send=()=>fetch('drive?linear='+s.v[0].toFixed(3)+'&angular='+s.v[1].toFixed(3)).catch(()=>0);
 s.go=(f,t)=>{const moved=f!=s.v[0]||t!=s.v[1],was=s.v[0]||s.v[1];s.v=[f,t];
  s.firstElementChild.style.left=(3.3-3.3*t)+'em';s.firstElementChild.style.top=(3.3-3.3*f)+'em';
  if(moved&&(!was||(!f&&!t)))s.send()};
 setInterval(()=>{if(s.v[0]||s.v[1])s.send()},100)">
"""


class DriveControls:
    """A joystick and keys that send velocities to the selected robot.

    It stands still again when the page sends nothing for a moment.

    Args:
        context: Of the page.
        server: Gets the values of the joystick.
    """

    def __init__(self, context: PageContext, server: PageServer) -> None:
        self._context = context
        self._lock = threading.Lock()
        self._driven: tuple[TwistInput, float] | None = None
        gui = context.gui
        with gui.add_folder("Drive"):
            self._robot = gui.add_markdown(_HINT)
            self._linear = gui.add_number("Speed [m/s]", 0.2, min=0.0, max=100.0, step=0.05)
            self._angular = gui.add_number("Turn [rad/s]", 1.0, min=0.0, max=100.0, step=0.1)
            gui.add_html(_STICK)
        server.handlers["drive"] = self._drive
        context.listeners.append(self.renew)

    def read(self) -> None:
        """Stop the robot if it is not steered any more."""
        with self._lock:
            driven = self._driven
            if driven is None or time.monotonic() < driven[1]:
                return
            self._driven = None
        self._context.guarded(lambda: driven[0].send(0.0, 0.0))

    def show(self, _state: None) -> None:
        """Do nothing: there is nothing to show."""

    def renew(self) -> None:
        """Show which robot is driven, after models changed."""
        robot = _HINT if self._port() is None else f"**{self._context.selected}**"
        if self._robot.content != robot:
            self._robot.content = robot

    def _port(self) -> TwistInput | None:
        robot = self._context.simulation.robots.get(self._context.selected)
        ports = () if robot is None else robot.inputs.values()
        return next((port for port in ports if isinstance(port, TwistInput)), None)

    def _drive(self, query: Mapping[str, str]) -> None:
        """Command the joystick's velocity; on the server's thread, which does not wait."""
        context, port = self._context, self._port()
        try:
            forward, turn = float(query["linear"]), float(query["angular"])
        except (KeyError, ValueError):
            return
        if port is None or not (math.isfinite(forward) and math.isfinite(turn)):
            return
        linear = max(-1.0, min(1.0, forward)) * float(self._linear.value)
        angular = max(-1.0, min(1.0, turn)) * float(self._angular.value)
        chosen = context.chosen if context.simulation.nworld > 1 else None
        with self._lock:
            moving = linear != 0.0 or angular != 0.0
            self._driven = (port, time.monotonic() + _LATE) if moving else None
        context.simulation.lock.post(
            lambda: context.guarded(lambda: port.send(linear, angular, chosen))
        )
