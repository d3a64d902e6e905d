"""A ghost of a model under the cursor of a page, until it is put down."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.builders import sphere
from gazelle.description import Light, Model, Pose, World
from gazelle.rotations import rotate
from gazelle.viewer.page.context import ROOT, PageContext
from gazelle.viewer.page.landing import landing_point
from gazelle.viewer.page.server import PageServer
from gazelle.viewer.page.shapes import ShapeBatches

_OPACITY = 0.45
_LAMP = 0.1  # radius of the ghost of a light [m]

_CURSOR = """
<img alt="" style="display:none" src="data:," onerror="window.gazelleGhost?.abort();
 const a=window.gazelleGhost=new AbortController(),c=document.querySelector('canvas[data-engine]'),s={{signal:a.signal}};
 let busy=false,last=null,down=null;
 const send=(e,more)=>{{const b=c.getBoundingClientRect();return fetch('ghost?client={client}&x='
  +(e.clientX-b.left)/b.width+'&y='+(e.clientY-b.top)/b.height+more).catch(()=>0)}};
 const pump=async()=>{{if(busy)return;busy=true;while(last&&!a.signal.aborted){{const e=last;last=null;await send(e,'')}}
  busy=false}};
 c.addEventListener('pointermove',e=>{{last=e;pump()}},s);
 c.addEventListener('pointerdown',e=>{{down=[e.clientX,e.clientY]}},s);
 c.addEventListener('pointerup',e=>{{if(!down||Math.hypot(e.clientX-down[0],e.clientY-down[1])>4)return;
  a.abort();send(e,'&end=put')}},s);
 document.addEventListener('keydown',e=>{{if(e.key=='Escape'){{a.abort();
  fetch('ghost?client={client}&end=cancel').catch(()=>0)}}}},s)">
"""


@dataclass(frozen=True, slots=True)
class _Carried:
    """A model on its way.

    Attributes:
        client: Page whose cursor has it.
        script: Follows the cursor there.
        frame: Moves the ghost.
        yaw: Heading [rad].
        put: Called with the pose.
    """

    client: Any
    script: Any
    frame: Any
    yaw: float
    put: Callable[[Pose], None]


class GhostPlacing:
    """Shows a ghost on what is below the cursor; a click puts the model there, Escape does not.

    Args:
        context: Of the page.
        server: Gets the cursor.
    """

    def __init__(self, context: PageContext, server: PageServer) -> None:
        self._context = context
        self._carried: _Carried | None = None
        server.handlers["ghost"] = self._moved

    def begin(
        self, client: Any, thing: Model | Light, yaw: float, put: Callable[[Pose], None]
    ) -> None:
        """Show a ghost at the cursor of a client; another one is given up."""
        self.end()
        context = self._context
        model = sphere(radius=_LAMP) if isinstance(thing, Light) else replace(thing, pose=Pose())
        frame = context.scene.add_frame(f"{ROOT}/ghost", show_axes=False, visible=False)
        batches = ShapeBatches(
            context.scene,
            f"{ROOT}/ghost/shapes",
            World(models=(model,)),
            np.zeros((1, 3)),
            opacity=_OPACITY,
        )
        at, turned = batches.rest
        batches.show(at[None], turned[None])
        frame.wxyz = (math.cos(yaw / 2.0), 0.0, 0.0, math.sin(yaw / 2.0))
        script = client.gui.add_html(_CURSOR.format(client=client.client_id))
        context.placing_until = math.inf
        self._carried = _Carried(client, script, frame, yaw, put)

    def end(self) -> None:
        """Show no ghost any more."""
        carried, self._carried = self._carried, None
        if carried is not None:
            # The click that puts it down arrives as a click on what is below, too.
            self._context.placing_until = time.monotonic() + 1.0
            carried.script.remove()
            carried.frame.remove()  # and what hangs on it

    def _moved(self, query: Mapping[str, str]) -> None:
        """Follow the cursor, or end; on the server's thread."""
        carried = self._carried
        if carried is None or query.get("client") != str(carried.client.client_id):
            return
        try:
            x, y = float(query.get("x", "nan")), float(query.get("y", "nan"))
        except ValueError:
            return
        eye, along = self._ray(carried.client.camera, x, y)
        ended = "end" in query
        self._context.simulation.lock.post(lambda: self._follow(carried, eye, along, ended=ended))

    def _follow(self, carried: _Carried, eye: Floats, along: Floats, *, ended: bool) -> None:
        """Move the ghost to what a ray meets, or put the model there; between two steps."""
        context = self._context
        if carried is not self._carried:
            return
        place = np.full(3, math.nan)
        if np.isfinite(along).all():
            place = landing_point(context.simulation, context.chosen, eye, along)
        seen = bool(np.isfinite(place).all())
        if ended:
            self.end()
            if seen:
                x, y, z = place.tolist()
                pose = Pose(x, y, z, yaw=carried.yaw)
                threading.Thread(
                    target=lambda: context.guarded(lambda: carried.put(pose)), daemon=True
                ).start()
        elif seen:
            carried.frame.position, carried.frame.visible = place + context.spot, True

    def _ray(self, camera: Any, x: float, y: float) -> tuple[Floats, Floats]:
        """Return start [m] and direction of the ray of a point of the picture, in its world."""
        high = math.tan(camera.fov / 2.0)
        ray = np.array([(2.0 * x - 1.0) * high * camera.aspect, (2.0 * y - 1.0) * high, 1.0])
        along = rotate(np.asarray(camera.wxyz)[[1, 2, 3, 0]], ray)
        context = self._context
        eye = np.asarray(camera.position) + context.heading * [1.0, 1.0, 0.0] - context.spot
        return eye, along
