"""Stage's controller ``wander``."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.native.system import System
from gazelle.stage.fleet import StageFleet
from gazelle.stage.ranger_controller import RangerController
from gazelle.stage.robots import Ranger, StageRobot
from gazelle.stage.wandering import Wandering
from gazelle.streams import Stream

CRUISE = 0.4  # [m/s]
CREEP = 0.05  # [m/s]
TURN = 0.5  # [rad/s]
FRONT = 1.0  # distance ahead at which it turns away [m]
STOP = 0.3  # distance at which it stands [m]
PATIENCE = 10  # least updates that it turns for, and how many more it may
_SHARE = 64  # robots that are worth a thread


class Wander(RangerController):
    """Goes ahead until something is near, then turns away from it for a while.

    Args:
        simulation: Runs.
        robots: Those it drives, each with what it looks at; all of one scanner.
        scanner: Index of the scanner.
    """

    def __init__(
        self, simulation: StageFleet, robots: list[tuple[StageRobot, Ranger]], scanner: int
    ) -> None:
        super().__init__(simulation, robots, scanner)
        self._turn_state = np.zeros((len(self._bodies), 2), np.int64)
        key = Stream(simulation.seed, f"wander/{scanner}", 1).keys[0]
        self._seed = int(key >> np.uint64(1))

    def rebind(self) -> None:
        """Find the robots and their rangers."""
        super().rebind()
        self._made: tuple[Floats, Wandering] | None = None

    def update(self) -> None:
        """Update speed and turn of every robot by its scan."""
        law, now = self._law(self._simulation.scan(self._scanner)), self._simulation.clock.now_ns
        self._simulation.fleet.pool.share(
            lambda first, last, _: law.choose(first, last, now), len(self._bodies), _SHARE
        )

    def systems(self) -> list[System] | None:
        """Return its systems; see `FleetController.systems`."""
        looking = self._simulation.scan_system(self._scanner)
        return None if looking is None else [looking[0], self._law(looking[1])]

    def reset(self, worlds: Worlds | None = None) -> None:
        """Stop turning."""
        rows = slice(None) if worlds is None else worlds
        self._turn_state.reshape(self._simulation.nworld, -1, 2)[rows] = 0

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return the remaining turning times."""
        return {"turn_state": self._turn_state.copy()}

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._turn_state[:] = state["turn_state"]

    def _law(self, ranges: Floats) -> Wandering:
        """Return the law for these ranges; kept while they are written to the same place."""
        if self._made is None or self._made[0] is not ranges:
            law = Wandering(
                self._simulation.fleet.command.reshape(-1, 3),
                ranges.reshape(-1, ranges.shape[-1]),
                self._sensors,
                self._bodies,
                self._turn_state,
                nworld=self._simulation.nworld,
                seed=self._seed,
                cruise=CRUISE,
                creep=CREEP,
                turn=TURN,
                front=FRONT,
                stop=STOP,
                patience=PATIENCE,
            )
            self._made = ranges, law
        return self._made[1]
