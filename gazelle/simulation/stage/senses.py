"""What robots of a Stage world see beside their rangers, asked for one by one."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gazelle.engines.planar.pictures import Pictures
from gazelle.simulation.stage.cameras import Cameras, cameras_of
from gazelle.simulation.stage.finders import (
    Blob,
    Fiducial,
    Surroundings,
    find_blobs,
    find_fiducials,
)

if TYPE_CHECKING:
    from gazelle.simulation.stage.simulation import StageSimulation


class Senses:
    """Cameras, fiducial finders and blob finders of a simulation; each is made when it is used.

    Args:
        simulation: Runs.
    """

    def __init__(self, simulation: StageSimulation) -> None:
        self._simulation = simulation
        self._cameras: Cameras | None = None

    def forget(self) -> None:
        """Something moved."""
        if self._cameras is not None:
            self._cameras.forget()

    @cached_property
    def _around(self) -> Surroundings:
        return Surroundings(self._simulation)

    def fiducials(self, robot: int, finder: int, world: int) -> list[Fiducial]:
        """See ``StageSimulation.fiducials``."""
        return find_fiducials(self._around, robot, finder, world)

    def blobs(self, robot: int, finder: int, world: int) -> list[Blob]:
        """See ``StageSimulation.blobs``."""
        return find_blobs(self._around, robot, finder, world)

    def picture(self, robot: int, camera: int, world: int) -> Pictures:
        """See ``StageSimulation.picture``."""
        return self._pictures().picture(robot, camera, world)

    def pictures(
        self, robots: Sequence[int] | None, camera: int, worlds: NDArray[np.intp] | None
    ) -> Pictures:
        """See ``StageSimulation.pictures``."""
        every = self._simulation.robots
        if robots is None:
            robots = [each.index for each in every if len(cameras_of(each.model)) > camera]
        if worlds is None:
            worlds = np.arange(self._simulation.nworld)
        return self._pictures().pictures(list(robots), camera, worlds)

    def _pictures(self) -> Cameras:
        if self._cameras is None:
            models = [robot.model for robot in self._simulation.robots]
            self._cameras = Cameras(self._simulation, models)
        return self._cameras
