"""Directions to look from, pictures and films of the page."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.rendering import PinholeLens
from gazelle.viewer.page.context import PageContext
from gazelle.viewer.page.shapes import extent_of_world
from gazelle.viewer.scene_camera import distance_to_see

LENS = PinholeLens(400, 400, 1.25)  # about that of the page
AROUND = np.array([-0.45, -0.75, 0.75])
DIRECTIONS = {
    "top": np.array([0.0, -0.001, 1.0]),  # from it, north is up
    "front": np.array([1.0, 0.0, 0.0]),
    "side": np.array([0.0, -1.0, 0.0]),
    "all": AROUND,
}
"""From the middle to the eye. Robots look along x, so the front is seen from there."""

_BUTTON = (
    '<button type="button" style="flex:1;font:inherit;font-size:0.9em;padding:0.15em;cursor:pointer;background:none;'
    'border:1px solid var(--mantine-color-custom-outline);color:var(--mantine-color-custom-outline)"'
)
_SAVING = f"""
<div id="gazelle-saving" style="display:flex;gap:0.5em;align-items:center;margin:0 0.75em 0.5em;font-size:0.8em">
<span style="width:7.9em;color:var(--mantine-color-dimmed)">Save</span>
{_BUTTON} title="what is seen, as a PNG" onclick="const c=document.querySelector('canvas[data-engine]');
 c.toBlob(b=>this.parentNode.save(b,'png'))">picture</button>
{_BUTTON} title="what is seen from now on, as a WebM, until the next click" onclick="const p=this.parentNode;
 if(p.film){{p.film.stop();p.film=null;this.textContent='film';return}}
 const parts=[],f=new MediaRecorder(document.querySelector('canvas[data-engine]').captureStream(25));
 p.size=0;f.ondataavailable=e=>{{parts.push(e.data);p.size+=e.data.size}};f.onstop=()=>p.save(new Blob(parts,{{type:'video/webm'}}),'webm');
 f.start(500);p.film=f;this.textContent='stop'">film</button></div>
<img alt="" style="display:none" src="data:," onerror="document.getElementById('gazelle-saving').save=(b,kind)=>{{
 const a=document.createElement('a');a.href=window.URL.createObjectURL(b);a.download='gazelle.'+kind;a.click();
 setTimeout(()=>window.URL.revokeObjectURL(a.href),10000)}}">
"""


class Viewpoints:
    """Buttons that place the eye of one page, and save what it sees.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context = context
        with context.gui.add_folder("View"):
            self._from = context.gui.add_button_group("From", tuple(DIRECTIONS))
            context.gui.add_html(_SAVING)
        self._from.on_click(self._place_eye)

    def read(self) -> None:
        """Do nothing: there is nothing to follow."""

    def show(self, _state: None) -> None:
        """Do nothing: there is nothing to show."""

    def renew(self) -> None:
        """Do nothing: the extent is measured with every click."""

    def _place_eye(self, event: Any) -> None:
        """Place the eye of the page that was clicked on."""
        camera, context = event.client.camera, self._context

        def place() -> None:
            middle, eye = overview(context, DIRECTIONS[event.target.value])
            with event.client.atomic():
                camera.up_direction = (0.0, 0.0, 1.0)
                camera.position, camera.look_at = eye, middle

        context.guarded(place)


def overview(context: PageContext, direction: Floats) -> tuple[Floats, Floats]:
    """Return the middle of all worlds on the page, and the eye that sees them from a direction [m]."""
    low, high = extent_of_world(context.simulation.world)
    low, high = low + context.spots.min(axis=0), high + context.spots.max(axis=0)
    middle = (low + high) / 2.0
    away = direction * distance_to_see((high - low) / 2.0, direction, LENS)
    shift = context.heading * [1.0, 1.0, 0.0]
    return middle - shift, middle + away - shift
