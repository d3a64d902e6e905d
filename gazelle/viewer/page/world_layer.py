"""The models of a simulation on the page, where they are now."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from gazelle.array_types import Floats
from gazelle.description import Link, Material, Visual
from gazelle.viewer.page.context import ROOT, OptionalLayer, PageContext
from gazelle.viewer.page.link_places import LinkPlaces
from gazelle.viewer.page.restyled import restyled
from gazelle.viewer.page.shapes import Instance, ShapeBatches

LOOKS = ("solid", "transparent", "wireframe")
_OPACITY = {"transparent": 0.35}
_ORANGE = (0.95, 0.55, 0.15, 1.0)


class ShapeLayer:
    """Visuals, or collision shapes.

    Args:
        context: Of the page.
        name: Under which they are.
        collisions: Whether collision shapes are shown, which can be seen through.
        on_batch: Called with every batch of shapes.
        shown: Whether they are shown at first.

    Attributes:
        shown: Whether they are shown.
        look: One of ``LOOKS``.
        veils: Layers inside the shapes, with which solid ones are transparent.
    """

    def __init__(
        self,
        context: PageContext,
        name: str,
        *,
        collisions: bool = False,
        on_batch: Callable[[Any, Callable[[int], Instance]], None] | None = None,
        shown: bool = True,
    ) -> None:
        self._context, self._root = context, f"{ROOT}/{name}"
        self._collisions, self._on_batch = collisions, on_batch
        self.shown = shown
        self._batches: ShapeBatches | None = None
        self._places: LinkPlaces | None = None
        self._look = LOOKS[0]  # of the present shapes
        self.look = LOOKS[0]
        self.veils: tuple[OptionalLayer, ...] = ()

    def read(self) -> tuple[Floats, Floats] | None:
        """Return places of all links, shapes (worlds, links, 3) and (worlds, links, 4)."""
        if not self.shown:
            return None
        look = self.look
        if look == LOOKS[0] and any(each.shown for each in self.veils):
            look = "transparent"
        if look != self._look:
            self._look = look
            self.renew()
        return self._made().read(self._context.worlds)

    def show(self, state: tuple[Floats, Floats] | None) -> None:
        """Move the shapes."""
        if self._batches is not None:
            self._batches.hide(hidden=state is None)
            if state is not None:
                self._batches.show(*state)

    def renew(self) -> None:
        """Mark the shapes as outdated: the next picture makes them again."""
        if self._batches is not None:
            self._batches.remove()
            self._batches = self._places = None

    def _made(self) -> LinkPlaces:
        if self._batches is None or self._places is None:
            context = self._context
            world = context.simulation.world
            if self._collisions:
                world = restyled(world, _bare_link)
            self._batches = ShapeBatches(
                context.scene,
                self._root,
                world,
                context.spots,
                self._on_batch,
                opacity=0.5 if self._collisions else _OPACITY.get(self._look, 1.0),
                wireframe=self._look == "wireframe",
            )
            self._places = LinkPlaces(context.simulation, self._batches.links)
        return self._places


def _bare_link(link: Link) -> Link:
    look = Material(diffuse=_ORANGE)
    return replace(
        link,
        visuals=tuple(
            Visual(each.name, pose=each.pose, geometry=each.geometry, material=look)
            for each in link.collisions
        ),
    )
