"""Tasks in which a robot goes somewhere: the reported way, and when it comes nearer."""

from __future__ import annotations

from abc import abstractmethod

import numpy as np

from gazelle.array_types import Bools, Floats, Floats32, Worlds
from gazelle.envs.batched_task import Info
from gazelle.envs.simulation_task import SimulationTask


class DestinationTask(SimulationTask):
    """A `SimulationTask` with the robot's place in its info from the reset on."""

    @abstractmethod
    def place_info(self, worlds: Worlds | None) -> Info:
        """Return the positions of the robot and its goal in these worlds; all if None."""

    def comes_closer(self, distance: Floats) -> Bools:
        """Return whether the robot is nearer to its goal than in the last step; store the distance.

        Args:
            distance: From the goal [m], shape (nworld,); ``memory["distance"]`` is the last one.
        """
        before = self.memory["distance"]
        closer: Bools = distance < before
        before[:] = distance
        return closer

    def _look(self, worlds: Worlds) -> tuple[Floats32, Info]:
        no = np.zeros(len(worlds), np.bool_)
        info = {"is_success": no, "is_collision": no.copy(), **self.place_info(worlds)}
        return super()._look(worlds)[0], info
