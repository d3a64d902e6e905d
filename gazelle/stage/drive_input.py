"""``cmd_vel`` of one of Stage's robots: a row of the commands of all."""

from __future__ import annotations

from collections.abc import Callable

from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.simulation.inputs import chosen
from gazelle.simulation.ports import TwistInput
from gazelle.simulation.state_lock import between_steps


class DriveInput(TwistInput):
    """Velocity commands of a robot; of a car its speed, and as turning its steering angle.

    Args:
        nworld: Number of worlds.
        commands: The robot's commands now, to be written, shape (nworld, 3).
        steers: Whether it is a car.
    """

    def __init__(self, nworld: int, commands: Callable[[], Floats], *, steers: bool) -> None:
        super().__init__(nworld, "cmd_vel")
        self.steers = steers
        self._commands = commands

    @between_steps
    def send(
        self,
        linear: ArrayLike = 0.0,
        angular: ArrayLike = 0.0,
        worlds: Worlds | None = None,
    ) -> None:
        """Send a command; see ``TwistInput.send``."""
        super().send(linear, angular, worlds)
        some = chosen(worlds, len(self.linear))
        rows = slice(None) if some is None else some
        commands = self._commands()
        commands[rows, :2] = self.linear[rows, :2]
        commands[rows, 2] = self.angular[rows, 2]

    @between_steps
    def clear(self, worlds: Worlds | None = None) -> None:
        """Discard the last command: stop."""
        super().clear(worlds)
        some = chosen(worlds, len(self.linear))
        self._commands()[slice(None) if some is None else some] = 0.0
