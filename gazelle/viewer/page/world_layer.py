"""The models of a simulation on the page, where they are now."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Link, Material, Visual
from gazelle.viewer.page.context import ROOT, PageContext
from gazelle.viewer.page.restyled import restyled
from gazelle.viewer.page.shapes import Instance, ShapeBatches

_ORANGE = (0.95, 0.55, 0.15, 1.0)


class ShapeLayer:
    """Visuals, or collision shapes.

    Args:
        context: Of the page.
        name: Under which they are.
        collisions: Whether collision shapes are shown, which can be seen through.
        on_batch: Called with every batch of shapes.
        shown: Whether they are shown at first.
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
        self._known = np.zeros(0, np.intp)
        self._links: tuple[str, ...] = ()

    def read(self) -> tuple[Floats, Floats] | None:
        """Return places of all links, shapes (worlds, links, 3) and (worlds, links, 4)."""
        if not self.shown:
            return None
        batches = self._made()
        engine, count = self._context.simulation.engine, len(self._context.worlds)
        at = np.repeat(batches.rest[0][None], count, axis=0)
        turned = np.repeat(batches.rest[1][None], count, axis=0)
        place = engine.links[self._links].placement(self._context.worlds)
        at[:, self._known], turned[:, self._known] = place.position, place.quaternion
        return at, turned

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
            self._batches = None

    def _made(self) -> ShapeBatches:
        if self._batches is None:
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
                opacity=0.5 if self._collisions else 1.0,
            )
            known = set(context.simulation.engine.links.names)
            links = self._batches.links
            self._known = np.array([k for k, link in enumerate(links) if link in known], np.intp)
            self._links = tuple(links[k] for k in self._known.tolist())
        return self._batches


def _bare_link(link: Link) -> Link:
    look = Material(diffuse=_ORANGE)
    return replace(
        link,
        visuals=tuple(
            Visual(each.name, pose=each.pose, geometry=each.geometry, material=look)
            for each in link.collisions
        ),
    )
