"""Grid on the ground, with its scale."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.viewer.page.context import ROOT, PageContext
from gazelle.viewer.page.shapes import extent_of_world

_ABOVE = 0.004  # the ground [m]
_CELL, _SECTION = (130, 130, 130), (60, 60, 60)


class GridLayer:
    """Lines a power of ten apart, one of which is labelled, and the axes of the world.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context, self.shown = context, False
        self._handles: list[Any] = []
        self._stale = True

    def read(self) -> bool:
        """Return whether the grid is shown."""
        return self.shown

    def show(self, state: bool) -> None:  # noqa: FBT001  as every layer
        """Draw the grid."""
        if state and self._stale:
            self._draw()
        for handle in self._handles:
            handle.visible = state

    def renew(self) -> None:
        """Measure the world again with the next picture."""
        self._stale = True

    def _draw(self) -> None:
        for handle in self._handles:
            handle.remove()
        self._stale = False
        context, scene = self._context, self._context.scene
        low, high = extent_of_world(context.simulation.world)
        low, high = low + context.spots.min(axis=0), high + context.spots.max(axis=0)
        cell = cell_for(float(np.max((high - low)[:2])))
        reach = 2.0 * max(float(np.abs((low, high))[:, :2].max()), 5.0 * cell)
        size = 2.0 * cell * math.ceil(reach / cell)
        grid = scene.add_grid(
            f"{ROOT}/grid", size, size, cell_size=cell, section_size=10.0 * cell,
            cell_color=_CELL, section_color=_SECTION, shadow_opacity=0.0,
            position=(0.0, 0.0, _ABOVE),
        )  # fmt: skip
        axes = scene.add_frame(
            f"{ROOT}/axes", axes_length=cell, axes_radius=0.01 * cell, position=(0.0, 0.0, _ABOVE)
        )
        label = scene.add_label(f"{ROOT}/scale", f"{cell:g} m", position=(cell, 0.0, _ABOVE))
        self._handles = [grid, axes, label]


def cell_for(extent: float) -> float:
    """Return the power of ten that goes two to twenty times into an extent [m].

    >>> [cell_for(each) for each in (0.5, 3.0, 15.0, 80.0)]
    [0.1, 1.0, 1.0, 10.0]
    """
    return 10.0 ** math.floor(math.log10(max(extent, 1e-3) / 2.0))
