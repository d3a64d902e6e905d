"""Places and directions of lights."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.rotations import rotate
from gazelle.viewer.page.context import ROOT, PageContext

_COLOR = (250, 190, 0)
_LENGTH = 0.4  # of an arrow [m]
_TIPS = _LENGTH / 2.0 * np.vstack((np.eye(3), -np.eye(3)))


class LightLayer:
    """An arrow along each directional or spot light, and a star at each point light.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context, self.shown = context, False
        self._arrows: Any = None
        self._drawn = b""

    def read(self) -> Floats:
        """Return starts and ends of arrows [m], shape (n, 2, 3)."""
        lines = [np.zeros((0, 2, 3))]
        lights = self._context.simulation.world.lights if self.shown else ()
        for light in lights:
            at = np.asarray(light.pose.position)
            along = rotate(np.asarray(light.pose.quaternion), np.asarray(light.direction))
            ends = _TIPS if light.type == "point" else _LENGTH * along[None] / np.linalg.norm(along)
            lines.append(np.stack((np.broadcast_to(at, ends.shape), at + ends), axis=1))
        return np.concatenate(lines)

    def show(self, state: Floats) -> None:
        """Draw the lights that changed, in the first world."""
        lines = (state + self._context.spots[0]).astype(np.float32)
        if (now := lines.tobytes()) == self._drawn:
            return
        self._drawn = now
        if self._arrows is not None:
            self._arrows.remove()
            self._arrows = None
        if len(lines):
            self._arrows = self._context.scene.add_arrows(
                f"{ROOT}/lights", lines, _COLOR,
                shaft_radius=0.015, head_radius=0.04, head_length=0.08,
            )  # fmt: skip

    def renew(self) -> None:
        """Do nothing: lights are read with every picture."""
