"""Links of many robots, read at once."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.argument_checks import checked
from gazelle.engines import Motion, Placement
from gazelle.errors import SimulationError
from gazelle.simulation.links import LinkHandle
from gazelle.simulation.running_state import RunningState
from gazelle.simulation.state_lock import between_steps


@checked(SimulationError, after=True)
class LinkArray:
    """Some links of one simulation, a column each; for plugins of many robots.

    Values are those of the links' handles, to the bit, read in one call.

    Args:
        simulation: Has them.
        links: At least one.
    """

    def __init__(self, simulation: RunningState, links: Sequence[LinkHandle]) -> None:
        self._lock = simulation.lock
        self._rows = simulation.engine.links[tuple(link.name for link in links)]

    @between_steps
    def placements(self) -> Placement:
        """Return their poses, shapes (nworld, links, 3) and (nworld, links, 4)."""
        return self._rows.placement()

    @between_steps
    def motions(self) -> Motion:
        """Return their velocities in the world frame, shape (nworld, links, 3)."""
        return self._rows.motion()
