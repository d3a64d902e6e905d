"""Links of many robots, read at once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.engines import Motion, Placement
from gazelle.simulation.links import LinkHandle
from gazelle.simulation.requests import between_steps
from gazelle.simulation.running_state import RunningState


class LinkArray:
    """Some links of one simulation, a column each; for plugins of many robots.

    It gives what each link's handle would, to the bit, in one call where the engine can.

    Args:
        simulation: Has them.
        links: At least one.
    """

    def __init__(self, simulation: RunningState, links: Sequence[LinkHandle]) -> None:
        self._simulation, self._requests = simulation, simulation.requests
        self._links, self._names = tuple(links), tuple(link.name for link in links)

    @between_steps
    def placements(self) -> Placement:
        """Return where they are: shapes (nworld, links, 3) and (nworld, links, 4)."""
        engine = self._simulation.tables
        if engine is not None:
            return engine.link_placements(self._names)
        found = [link.placement() for link in self._links]
        return Placement(
            np.stack([each.position for each in found], axis=1),
            np.stack([each.quaternion for each in found], axis=1),
        )

    @between_steps
    def motions(self) -> Motion:
        """Return how they move in the world frame, shape (nworld, links, 3)."""
        engine = self._simulation.tables
        if engine is not None:
            return engine.link_motions(self._names)
        found = [link.motion() for link in self._links]
        return Motion(
            np.stack([each.linear for each in found], axis=1),
            np.stack([each.angular for each in found], axis=1),
        )
