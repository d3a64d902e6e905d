"""Stage's well-known controllers, each for all robots that name it at once.

Their figures are those of the controllers of the same names that come with Stage.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import SimulationWarning
from gazelle.simulation.stage.layout import StageRobot
from gazelle.streams import Stream

if TYPE_CHECKING:
    from gazelle.simulation.stage.simulation import StageSimulation

Floats = NDArray[np.float64]

CRUISE = 0.4  # [m/s]
CREEP = 0.05  # [m/s]
TURN = 0.5  # [rad/s]
FRONT = 1.0  # distance ahead at which it turns away [m]
STOP = 0.3  # distance at which it stands [m]
PATIENCE = 10  # least updates that it turns for, and how many more it may
DEVIATION = 0.05  # of lasernoise [m]


class Controller(Protocol):
    """Drives robots, or changes what they see."""

    def update(self) -> None:
        """Act on the state between two steps."""

    def reset(self) -> None:
        """Start over."""


def make_controllers(simulation: StageSimulation) -> list[Controller]:
    """Those that the world's robots name; others have been warned of when it was loaded."""
    named: dict[str, list[tuple[StageRobot, str]]] = {}
    for robot in simulation.robots:
        models = [robot.model, *(ranger.model for ranger in robot.rangers)]
        for controller in (each for model in models for each in model.controllers):
            named.setdefault(controller.name, []).append((robot, controller.arguments))
    made: list[Controller] = []
    for name, wanted in named.items():
        maker = _MAKERS.get(name)
        if maker is not None:
            made += maker(simulation, wanted)
    return made


class Wander:
    """Goes ahead until something is near, then turns away from it for a while.

    Args:
        simulation: Runs.
        robots: Those it drives; all with a first ranger of one scanner.
        scanner: That.
    """

    def __init__(self, simulation: StageSimulation, robots: list[StageRobot], scanner: int) -> None:
        self._simulation = simulation
        self._scanner = scanner
        self._robots = np.array([robot.index for robot in robots])
        self._places = np.array([robot.rangers[0].places[0][1] for robot in robots])
        shape = (simulation.nworld, len(robots))
        self._left = np.zeros(shape, np.int64)
        self._turn = np.zeros(shape)
        self._stream = Stream(simulation.seed, f"wander/{scanner}", simulation.nworld)

    def update(self) -> None:
        """Look, and choose speed and turn of every robot."""
        ranges = self._simulation.scan(self._scanner)[:, self._places]
        count = ranges.shape[-1]
        third = count // 3
        ahead = ranges[..., third : max(count - third, third + 1)].min(axis=-1)
        near = ahead < FRONT
        right = ranges[..., : max(count // 2, 1)].min(axis=-1)
        left = ranges[..., count // 2 :].min(axis=-1)
        begin = near & (self._left < 1)
        drawn = self._stream.uniform(self._left.shape[1]) * PATIENCE
        self._left = np.where(begin, PATIENCE + drawn.astype(np.int64), self._left)
        self._turn = np.where(begin, np.where(left < right, -TURN, TURN), self._turn)
        turning = near | (self._left > 0)
        speed = np.where(turning, np.where(ahead < STOP, 0.0, CREEP), CRUISE)
        command = self._simulation.commands
        command[:, self._robots, 0] = speed
        command[:, self._robots, 1] = 0.0
        command[:, self._robots, 2] = np.where(turning, self._turn, 0.0)
        self._left = np.where(turning, self._left - 1, 0)

    def reset(self) -> None:
        """Start over."""
        self._left[:] = 0
        self._turn[:] = 0.0
        self._stream.rewind()


class LaserNoise:
    """Adds white noise to what the rangers of some robots measure; it acts in the scan itself."""

    def __init__(self, simulation: StageSimulation, robots: list[tuple[StageRobot, str]]) -> None:
        for robot, arguments in robots:
            deviation = _number(arguments, DEVIATION)
            for ranger in robot.rangers:
                for scanner, place in ranger.places:
                    simulation.noise[scanner].constant[place] += deviation

    def update(self) -> None:
        """Nothing: the noise is in the scans."""

    def reset(self) -> None:
        """Nothing to start over."""


def _number(text: str, default: float) -> float:
    try:
        return abs(float(text.split(maxsplit=1)[0])) if text.split() else default
    except ValueError:
        return default


def _make_wander(
    simulation: StageSimulation, wanted: list[tuple[StageRobot, str]]
) -> list[Controller]:
    groups: dict[int, list[StageRobot]] = {}
    blind = []
    for robot, _ in wanted:
        if robot.rangers and robot.rangers[0].places:
            groups.setdefault(robot.rangers[0].places[0][0], []).append(robot)
        else:
            blind.append(robot.name)
    if blind:
        warnings.warn(
            f"'wander' needs a ranger; these have none and stand: {', '.join(blind[:5])}",
            SimulationWarning,
            stacklevel=2,
        )
    return [Wander(simulation, robots, scanner) for scanner, robots in groups.items()]


def _make_noise(
    simulation: StageSimulation, wanted: list[tuple[StageRobot, str]]
) -> list[Controller]:
    return [LaserNoise(simulation, wanted)]


_MAKERS: dict[str, Callable[[StageSimulation, list[tuple[StageRobot, str]]], list[Controller]]] = {
    "wander": _make_wander,
    "lasernoise": _make_noise,
}
