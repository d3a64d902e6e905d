"""``cmd_vel`` of one of Stage's robots: a row of the commands of all."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Worlds
from gazelle.simulation.inputs import chosen, size_of
from gazelle.simulation.ports import TwistInput
from gazelle.simulation.requests import between_steps

if TYPE_CHECKING:
    from gazelle.simulation.stage.fleet import StageFleet


class DriveInput(TwistInput):
    """Velocity commands of a robot; of a car its speed, and as turning its steering angle.

    Args:
        fleet: All robots.
        name: Of the robot.
    """

    def __init__(self, fleet: StageFleet, name: str) -> None:
        super().__init__(fleet.nworld, "cmd_vel")
        self._fleet, self._name = fleet, name

    @between_steps
    def send(
        self,
        linear: ArrayLike = 0.0,
        angular: ArrayLike = 0.0,
        worlds: Worlds | None = None,
    ) -> None:
        """See ``TwistInput.send``."""
        super().send(linear, angular, worlds)
        some = chosen(worlds, self._fleet.nworld)
        rows = np.arange(self._fleet.nworld) if some is None else some
        size_of(some, self._fleet.nworld)
        own = self._fleet.commands[:, self._fleet.robot(self._name).index]
        own[rows] = np.column_stack((self.linear[rows, :2], self.angular[rows, 2]))

    @between_steps
    def clear(self, worlds: Worlds | None = None) -> None:
        """Forget the last command: stand still."""
        super().clear(worlds)
        rows = slice(None) if worlds is None else worlds
        self._fleet.commands[rows, self._fleet.robot(self._name).index] = 0.0
