"""Box around the selected model or link."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.rotations import rotate
from gazelle.viewer.page.context import ROOT, PageContext, ScenePart
from gazelle.viewer.page.link_places import LinkPlaces
from gazelle.viewer.page.shapes import corners_around, corners_of_links

_COLOR = (255, 140, 0)
_ROOM = 0.01  # between shapes and box [m]
_EDGES = np.array(
    [
        (one, other)
        for one, other in itertools.combinations(range(8), 2)
        if (one ^ other).bit_count() == 1
    ]
)


class SelectionBox:
    """Draws the edges of a box: along the axes of the world around a model, of a link around that.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context = context
        self._corners: dict[str, Floats] = {}
        self._places = LinkPlaces(context.simulation, ())
        self._lines: Any = None
        self.renew()

    def read(self) -> Floats | None:
        """Return the edges [m], shape (12, 2, 3); None without a selection that can be seen."""
        links = self._links()
        if not links:
            return None
        if links != self._places.links:
            self._places = LinkPlaces(self._context.simulation, links)
        (at,), (turned,) = self._places.read(self._context.chosen)
        if len(links) == 1:
            box = corners_around(self._corners[links[0]], _ROOM)
            placed = at[0] + rotate(turned[0][None], box)
        else:
            points = [
                place + rotate(turn[None], self._corners[link])
                for link, place, turn in zip(links, at, turned, strict=True)
            ]
            placed = corners_around(np.vstack(points), _ROOM)
        edges: Floats = (placed + self._context.spot)[_EDGES]
        return edges

    def show(self, state: Floats | None) -> None:
        """Draw the edges."""
        if self._lines is not None:
            self._lines.visible = state is not None
        if state is None:
            return
        lines = state.astype(np.float32)
        if self._lines is None:
            self._lines = self._context.scene.add_line_segments(
                f"{ROOT}/selection", lines, _COLOR, thickness=2.0, thickness_units="screen"
            )
        elif not np.array_equal(self._lines.points, lines):
            self._lines.points = lines

    def renew(self) -> None:
        """Measure the links again, after models changed."""
        simulation = self._context.simulation
        self._corners, self._places = corners_of_links(simulation.world), LinkPlaces(simulation, ())

    def _links(self) -> tuple[str, ...]:
        """Return the links inside the box."""
        part = self._context.part
        if part.kind in ("collision", "sensor"):
            part = ScenePart("link", part.name.rpartition("::")[0])
        if part.kind == "link":
            return (part.name,) if part.name in self._corners else ()
        prefix = f"{self._context.selected}::"
        return tuple(link for link in self._corners if link.startswith(prefix))
