"""Robots of Stage's worlds, and the rows of an engine's arrays that belong to them."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from gazelle.errors import SimulationWarning
from gazelle.stage.description import (
    StageActuator,
    StageModel,
    StagePose,
    StagePosition,
    StageSensor,
)


@dataclass(frozen=True, slots=True)
class Ranger:
    """Ranger on a robot.

    Attributes:
        name: Its whole name.
        model: Settings of the file.
        sensors: Settings of each of its sensors.
        places: Of each sensor the index of its scanner, and its row in that.
        pose: In the robot's frame, its height included.
        direct: Whether it is mounted on the robot itself.
    """

    name: str
    model: StageModel
    sensors: tuple[StageSensor, ...]
    places: tuple[tuple[int, int], ...]
    pose: StagePose
    direct: bool = True

    def sensor_name(self, number: int) -> str:
        """Return the name of a sensor on its robot."""
        own = self.name.partition(".")[2]
        return own if len(self.sensors) == 1 else f"{own}/{number}"


@dataclass(frozen=True, slots=True)
class MountedActuator:
    """Actuator on a robot with all that is mounted on it: a body of its own.

    Attributes:
        body: Its index among all bodies of a world.
        model: The actuator, at position zero at the origin of its frame.
        device: Settings of the file.
        base: Of position zero, on the robot.
    """

    body: int
    model: StageModel
    device: StageActuator
    base: StagePose


@dataclass(frozen=True, slots=True)
class StageRobot:
    """Robot of a Stage world.

    Attributes:
        index: Its row in all arrays.
        name: Its name in the world.
        model: Settings of the file.
        rangers: Those mounted on it directly or indirectly, in file order; those on
            actuators last.
        mounted_actuators: Bodies of its actuators.
    """

    index: int
    name: str
    model: StageModel
    rangers: tuple[Ranger, ...] = ()
    mounted_actuators: tuple[MountedActuator, ...] = ()

    @property
    def bodies(self) -> Iterator[tuple[int, StageModel]]:
        """Indices and models: itself without its actuators, then the bodies of those."""
        yield self.index, without_actuators(self.model) if self.mounted_actuators else self.model
        for actuator in self.mounted_actuators:
            yield actuator.body, actuator.model

    @property
    def position(self) -> StagePosition:
        """Position model: drive and localization."""
        return self.model.position or StagePosition()


def without_actuators(model: StageModel) -> StageModel:
    """Return a model without the bodies that its actuators move."""
    kept = (child for child in model.children if child.device_of(StageActuator) is None)
    return replace(model, children=tuple(without_actuators(child) for child in kept))


def warn_of_mounted_drives(robots: Sequence[StageRobot]) -> None:
    """Warn of position models on robots: they do not drive; once for robots of one macro."""
    known = set()
    for robot in robots:
        if (kind := id(robot.model.children)) in known:
            continue
        known.add(kind)
        own = replace(without_actuators(robot.model), pose=StagePose()).walk()
        for placed in list(own)[1:]:
            if placed.model.position is not None:
                warnings.warn(
                    f"'{placed.name}' is mounted on a robot, and does not drive by itself",
                    SimulationWarning,
                    stacklevel=2,
                )
