"""Controllers that drive robots by what their rangers measure."""

from __future__ import annotations

import numpy as np

from gazelle.stage.fleet import StageFleet
from gazelle.stage.fleet_controller import FleetController
from gazelle.stage.robots import Ranger, StageRobot


class RangerController(FleetController):
    """Base of controllers of robots with a ranger each.

    Args:
        simulation: Runs.
        robots: Those it drives, each with what it looks at; all of one scanner.
        scanner: Index of the scanner.
    """

    def __init__(
        self, simulation: StageFleet, robots: list[tuple[StageRobot, Ranger]], scanner: int
    ) -> None:
        self._simulation, self._scanner = simulation, scanner
        self._own = np.array([robot.index for robot, _ in robots], np.int64)
        self._places = np.array([ranger.places[0][1] for _, ranger in robots], np.int64)
        self.rebind()

    def rebind(self) -> None:
        """Find the robots and their rangers."""
        simulation = self._simulation
        worlds = np.arange(simulation.nworld, dtype=np.int64)[:, None]
        self._bodies = (worlds * simulation.fleet.nbody + self._own).ravel()
        count = len(simulation.mounts[self._scanner])
        self._sensors = (worlds * count + self._places).ravel()
