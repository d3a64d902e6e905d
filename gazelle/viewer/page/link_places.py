"""Poses of links in the worlds on the page, of links that never move too."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.simulation import Simulation
from gazelle.viewer.page.shapes import rest_of


class LinkPlaces:
    """Reads the poses of some links at once; made again when models come or go.

    Args:
        simulation: With any engine.
        links: Scoped names.

    Attributes:
        links: Likewise.
    """

    def __init__(self, simulation: Simulation, links: tuple[str, ...]) -> None:
        self._simulation, self.links = simulation, links
        self._rest = rest_of(simulation.world, links)
        known = set(simulation.engine.links.names)
        self._known = np.array([k for k, link in enumerate(links) if link in known], np.intp)
        self._names = tuple(links[k] for k in self._known.tolist())

    def read(self, worlds: Worlds) -> tuple[Floats, Floats]:
        """Return positions (worlds, links, 3) [m] and quaternions (worlds, links, 4)."""
        at = np.repeat(self._rest[0][None], len(worlds), axis=0)
        turned = np.repeat(self._rest[1][None], len(worlds), axis=0)
        place = self._simulation.engine.links[self._names].placement(worlds)
        at[:, self._known], turned[:, self._known] = place.position, place.quaternion
        return at, turned
