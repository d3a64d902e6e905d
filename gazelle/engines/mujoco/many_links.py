"""Many links at once: where they are, how they move, and what rays that they carry meet."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.engines.motion import Motion, Placement
from gazelle.engines.mujoco.forcing import ForcedSteps
from gazelle.engines.mujoco.link_table import MujocoLinkTable
from gazelle.engines.mujoco.rays import nearest
from gazelle.engines.mujoco.running import RunningWorlds
from gazelle.rotations import turns

_MOST = 64  # tables kept


class ManyLinks:
    """The part of ``gazelle.engines.table_engine.TableEngine``.

    Args:
        run: What runs.
        stepper: Makes the coming step.
    """

    def __init__(self, run: RunningWorlds, stepper: ForcedSteps) -> None:
        self._run, self._stepper = run, stepper
        self._tables: dict[tuple[str, ...], MujocoLinkTable] = {}

    def link_placements(self, links: Sequence[str], worlds: Worlds | None = None) -> Placement:
        """Where many links are at once: shapes (n, links, 3) and (n, links, 4)."""
        table = self._table_of(links)
        if table.moving:
            self._run.refresh()
        return table.placement(self._run.batch, self._run.state, worlds)

    def link_motions(self, links: Sequence[str]) -> Motion:
        """How many links move at once, shape (nworld, links, 3)."""
        table = self._table_of(links)
        if table.moving:
            self._run.refresh()
        return table.motion(self._run.batch, self._run.state)

    def link_accelerations(self, links: Sequence[str]) -> Motion:
        """How that changes in the next physics step, which is made once for all."""
        return self._stepper.change_in_step(lambda: self.link_motions(links), None)

    def cast_ranges_together(
        self, links: Sequence[str], origins: Floats, directions: Floats
    ) -> tuple[Floats, float]:
        """Follow the rays of many range finders in one call; see the protocol."""
        place = self.link_placements(links)
        turn = turns(place.quaternion.reshape(-1, 4)).reshape(-1, len(origins), 3, 3)
        start = place.position[:, :, None, :] + origins @ turn
        shape = start.shape
        along = (directions @ turn).reshape(shape[0], -1, 3)
        start = start.reshape(shape[0], -1, 3)
        hits = nearest(self._run.batch, start, along, None)[0]
        ranges = np.where(hits.from_inside, -np.inf, hits.distance)
        return ranges.reshape(shape[:3]), 0.0

    def _table_of(self, links: Sequence[str]) -> MujocoLinkTable:
        layout, key = self._run.known(), tuple(links)
        table = self._tables.get(key)
        if table is None or table.layout is not layout:
            if len(self._tables) >= _MOST:
                self._tables.clear()
            table = self._tables[key] = MujocoLinkTable(layout, key)
        return table
