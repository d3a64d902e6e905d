"""Camera images of robots, on the page's panel."""

from __future__ import annotations

import time
from typing import Any

from gazelle.array_types import Picture
from gazelle.sensors import CameraModel
from gazelle.viewer.page.context import PageContext

_PERIOD = 0.2  # wall time between two pictures [s]
_MOST = 4
_WIDTH = 240  # of a picture, at most [pixel]


class CameraInsets:
    """Pictures of cameras, drawn for the page alone: sensors and their noise are left alone.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context, self.shown = context, False
        self._folder = context.gui.add_folder("Cameras", visible=False)
        self._images: dict[str, Any] = {}
        self._next = 0.0

    def read(self) -> dict[str, Picture] | None:
        """Return pictures by the names of cameras; None before the next ones are due."""
        if not self.shown:
            return {}
        now = time.monotonic()
        if now < self._next:
            return None
        self._next = now + _PERIOD
        cameras = [
            (unit.name, unit.model)
            for unit in tuple(self._context.simulation.entities.sensors)
            if isinstance(unit.model, CameraModel)
        ]
        return {name: self._picture(model) for name, model in cameras[:_MOST]}

    def show(self, state: dict[str, Picture] | None) -> None:
        """Show the pictures."""
        if state is None:
            return
        for name in [name for name in self._images if name not in state]:
            self._images.pop(name).remove()
        self._folder.visible = bool(state)
        for name, picture in state.items():
            if name in self._images:
                self._images[name].image = picture
                continue
            with self._folder:
                self._images[name] = self._context.gui.add_image(picture, label=name, format="jpeg")

    def renew(self) -> None:
        """Do nothing: sensors are looked up with every picture."""

    def _picture(self, model: CameraModel) -> Picture:
        found: Picture = model.preview(self._context.chosen, _WIDTH)[0]
        return found
