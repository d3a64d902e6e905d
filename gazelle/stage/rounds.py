"""A controller that drives robots in a round, from each one's starting place to the next."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Indices, Worlds
from gazelle.stage.fleet import StageFleet
from gazelle.stage.ranger_controller import RangerController
from gazelle.stage.robots import Ranger, StageRobot

_SPEED = 0.8  # [m/s]
_TURN = 1.0  # [rad/s]
_GAIN = 2.0  # yaw rate for each radian to turn, speed for each metre of room [1/s]
_ALIGNED = 0.3  # with the goal farther off ahead a robot turns on the spot [rad]
_ARRIVED = 0.3  # [m]
_GAP = 0.5  # to what is ahead [m]


class Rounds(RangerController):
    """Drives to the place where the next robot of a tour started, and on; waits for the robot ahead.

    Starting places are free of walls, and a shortest tour crosses itself nowhere, so robots meet only
    one behind the other.

    Args:
        simulation: Runs.
        robots: Those it drives, each with what it looks at; all of one scanner.
        scanner: Index of the scanner.
    """

    def __init__(
        self, simulation: StageFleet, robots: list[tuple[StageRobot, Ranger]], scanner: int
    ) -> None:
        super().__init__(simulation, robots, scanner)
        self._starts = simulation.poses[0, self._own, :2].copy()
        self._tour = short_tour(self._starts)
        self._rank = np.tile(np.argsort(self._tour), simulation.nworld)
        self._visits = np.zeros(simulation.nworld * len(robots), np.int64)

    @property
    def goals(self) -> Floats:
        """Goals of the robots in all worlds (x, y) [m], shape (nworld * nrobot, 2)."""
        goals: Floats = self._starts[self._tour[(self._rank + self._visits + 1) % len(self._tour)]]
        return goals

    def update(self) -> None:
        """Update speed and turn of every robot by its goal and its scan."""
        simulation = self._simulation
        poses = simulation.poses[:, self._own].reshape(-1, 3)
        self._visits[np.hypot(*(self.goals - poses[:, :2]).T) < _ARRIVED] += 1
        x, y = (self.goals - poses[:, :2]).T
        error = np.arctan2(y, x) - poses[:, 2]
        error = np.arctan2(np.sin(error), np.cos(error))
        ranges = simulation.scan(self._scanner)
        ranges = ranges.reshape(-1, ranges.shape[-1])[self._sensors]
        room = _GAIN * (ranges.min(axis=1) - _GAP)
        speed = np.where(np.abs(error) < _ALIGNED, np.clip(room, 0.0, _SPEED), 0.0)
        commands = simulation.fleet.command.reshape(-1, 3)
        commands[self._bodies, 0], commands[self._bodies, 1] = speed, 0.0
        commands[self._bodies, 2] = np.clip(_GAIN * error, -_TURN, _TURN)

    def reset(self, worlds: Worlds | None = None) -> None:
        """Start over with the first goals."""
        rows = slice(None) if worlds is None else worlds
        self._visits.reshape(self._simulation.nworld, -1)[rows] = 0

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return the numbers of goals that were reached."""
        return {"visits": self._visits.copy()}

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._visits[:] = state["visits"]


def short_tour(points: Floats) -> Indices:
    """Return the order of a round tour that does not cross itself.

    It starts with the nearest neighbour each, and parts are reversed while that makes it shorter
    (2-opt, G. A. Croes, "A Method for Solving Traveling-Salesman Problems", 1958).

    Args:
        points: x, y [m], shape (n, 2).
    """
    far = np.hypot(*(points[:, None] - points).transpose(2, 0, 1))
    order = _nearest_next(far)
    shorter = True
    while shorter:
        shorter = False
        for first in range(len(order) - 2):
            a, b = order[first], order[first + 1]
            c, d = order[first + 2 :], np.roll(order, -1)[first + 2 :]
            gain = far[a, b] + far[c, d] - far[a, c] - far[b, d]
            best = int(gain.argmax())
            if gain[best] > 1e-9:
                last = first + 2 + best
                order[first + 1 : last + 1] = order[first + 1 : last + 1][::-1].copy()
                shorter = True
    return order


def _nearest_next(far: Floats) -> Indices:
    """Return a tour that goes on with the nearest point each; distances have shape (n, n)."""
    left = np.ones(len(far), np.bool_)
    order = np.zeros(len(far), np.intp)
    for number in range(1, len(far)):
        left[order[number - 1]] = False
        order[number] = np.where(left, far[order[number - 1]], np.inf).argmin()
    return order
