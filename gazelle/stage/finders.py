"""Fiducial finders and blob finders: what Stage's robots recognise, by queries one by one."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Generic, TypeVar

import numpy as np

from gazelle.description import Color
from gazelle.errors import SimulationError
from gazelle.stage.description import (
    PlacedStageModel,
    StageBlobfinder,
    StageBumper,
    StageFiducial,
    StageModel,
    StagePose,
)
from gazelle.stage.outlines import Outlines, distances, joined, outlines_of
from gazelle.stage.scenery import color_of
from gazelle.stage.stage_bodies import StageBodies

Device = TypeVar("Device", StageFiducial, StageBlobfinder, StageBumper)


@dataclass(frozen=True, slots=True)
class MountedFinder(Generic[Device]):
    """A finder: where it is in the world, and what the file says of it."""

    pose: StagePose
    model: StageModel
    device: Device


@dataclass(frozen=True, slots=True)
class Fiducial:
    """A model that a fiducial finder sees.

    Attributes:
        name: Whole name of the model.
        id: Its ``fiducial_return``; 0 if it is too far away to be read.
        distance: To its middle [m].
        bearing: To its middle, from the finder's x axis [rad].
        heading: Of it, from the finder's x axis [rad].
    """

    name: str
    id: int
    distance: float
    bearing: float
    heading: float


@dataclass(frozen=True, slots=True)
class Blob:
    """A patch of one colour that a blob finder sees.

    Attributes:
        color: Of the models in it.
        left: Its first column.
        right: Its last column.
        distance: To it, the mean of its columns [m].
    """

    color: Color
    left: int
    right: int
    distance: float


class Surroundings:
    """All models of a world with their outlines, where they are now.

    Args:
        simulation: Runs.
    """

    def __init__(self, simulation: StageBodies) -> None:
        self._simulation = simulation
        self._moving = models_of(simulation)
        self._still = [placed for model in simulation.still for placed in model.walk()]
        self._walls = outlines_of(self._still)
        self._shapes: dict[tuple[int, int], Outlines] = {}

    @property
    def resolution(self) -> float:
        """Side of a cell of Stage's grid [m]."""
        return self._simulation.description.resolution

    def model(self, robot: int) -> StageModel:
        """Return the description of a robot in the file."""
        return self._simulation.robots[robot].model

    def place(self, body: int, world: int) -> StagePose:
        """Return the pose of a robot or, after all robots, of an object."""
        fleet = self._simulation.fleet
        x, y, yaw = fleet.pose[world, body].tolist()
        return StagePose(x, y, float(fleet.heights[world, body]), yaw)

    def around(
        self, robot: int, reach: float, world: int
    ) -> tuple[list[PlacedStageModel], Outlines]:
        """Return models within reach of a robot but its own, and their outlines, in the world."""
        poses = self._simulation.fleet.pose[world]
        models, parts = list(self._still), [(self._walls, 0)]
        far = np.linalg.norm(poses[:, :2] - poses[robot, :2], axis=1)
        near = np.flatnonzero(far <= reach + 2.0 * self._simulation.fleet.widest)
        own = [body for body, _ in self._simulation.robots[robot].bodies]
        for other in near[~np.isin(near, own)].tolist():
            model = self._moving[other]
            pose = self.place(other, world)
            parts.append((self._shape(model).moved(pose), len(models)))
            models += replace(model, pose=pose).walk()
        return models, joined(parts)

    def _shape(self, model: StageModel) -> Outlines:
        """Return the outlines of a robot and what is on it, in its frame.

        Shared within a macro.
        """
        key = (id(model.blocks), id(model.children))
        if key not in self._shapes:
            self._shapes[key] = outlines_of(list(replace(model, pose=StagePose()).walk()))
        return self._shapes[key]

    def mounted(
        self, robot: int, kind: type[Device], which: int, world: int
    ) -> MountedFinder[Device]:
        """Return a finder of a robot.

        Raises:
            SimulationError: It has none of this number.
        """
        own = self._simulation.robots[robot]
        found = [
            MountedFinder(placed.pose, placed.model, placed.model.device)
            for body, model in own.bodies
            for placed in replace(model, pose=self.place(body, world)).walk()
            if isinstance(placed.model.device, kind)
        ]
        if not 0 <= which < len(found):
            raise SimulationError(
                f"'{own.name}' has {len(found)} {kind.__name__}, no number {which}"
            )
        return found[which]


def models_of(simulation: StageBodies) -> list[StageModel]:
    """Return the model of each body: robots, objects and placed models, then actuators' parts."""
    own = [next(robot.bodies)[1] for robot in simulation.robots]
    others = [StageModel("model", "")] * _other_bodies(simulation)
    mounted_actuators = [
        actuator.model for robot in simulation.robots for actuator in robot.mounted_actuators
    ]
    return [*own, *simulation.things, *simulation.placed, *others, *mounted_actuators]


def _other_bodies(simulation: StageBodies) -> int:
    """Return the number of bodies that are of no Stage file."""
    mounted_actuators = sum(len(robot.mounted_actuators) for robot in simulation.robots)
    known = (
        len(simulation.robots) + len(simulation.things) + len(simulation.placed) + mounted_actuators
    )
    return simulation.fleet.nbody - known


def find_fiducials(around: Surroundings, robot: int, which: int, world: int) -> list[Fiducial]:
    """Return the fiducials that a finder of a robot sees, nearest first.

    Raises:
        SimulationError: It has no such finder.
    """
    finder = around.mounted(robot, StageFiducial, which, world)
    device, here = finder.device, finder.pose
    models, lines = around.around(robot, device.range[1], world)
    level = lines.at(here.z)
    found = []
    for index, each in enumerate(models):
        returns = each.model.returns
        if returns.fiducial == 0 or returns.fiducial_key != finder.model.returns.fiducial_key:
            continue
        dx, dy = each.pose.x - here.x, each.pose.y - here.y
        distance = math.hypot(dx, dy)
        bearing = _wrapped(math.atan2(dy, dx) - here.yaw)
        if distance >= device.range[1] or abs(bearing) > device.fov / 2.0:
            continue  # as in Stage it does not matter how near something is
        met = distances(here.x, here.y, np.array([here.yaw + bearing]), level)[0]
        own = float(met[level.owners == index].min(initial=np.inf))
        if math.isinf(own) and device.ignore_height:
            own = distance
        if math.isfinite(own) and own <= met.min(initial=np.inf):
            number = returns.fiducial if distance < device.range_id else 0
            heading = _wrapped(each.pose.yaw - here.yaw)
            found.append(Fiducial(each.name, number, distance, bearing, heading))
    return sorted(found, key=lambda each: each.distance)


def find_blobs(around: Surroundings, robot: int, which: int, world: int) -> list[Blob]:
    """Return the blobs that a finder of a robot sees, from left to right, whatever its height.

    Its columns are spread from edge to edge of its field of view, as in Stage.

    Raises:
        SimulationError: It has no such finder.
    """
    finder = around.mounted(robot, StageBlobfinder, which, world)
    device, here = finder.device, finder.pose
    models, lines = around.around(robot, device.range, world)
    columns = device.image[0]
    aside = np.linspace(0.5, -0.5, columns) * device.fov if columns > 1 else np.zeros(1)
    met = distances(here.x, here.y, here.yaw + device.pan + aside, lines)
    nearest = met.min(axis=1, initial=np.inf)
    blobs: list[Blob] = []
    for column in np.flatnonzero(nearest <= device.range).tolist():
        seen = models[int(lines.owners[int(met[column].argmin())])].model
        color = color_of(seen)
        if seen.returns.blob and (not device.colors or color in device.colors):
            _add(blobs, Blob(color, column, column, float(nearest[column])))
    return blobs


def _add(blobs: list[Blob], new: Blob) -> None:
    """Add a column to the last blob if it continues, else as a new one."""
    last = blobs[-1] if blobs else None
    if last is None or last.right != new.left - 1 or last.color != new.color:
        blobs.append(new)
        return
    width = last.right - last.left + 1
    mean = (width * last.distance + new.distance) / (width + 1)
    blobs[-1] = replace(last, right=new.right, distance=mean)


def _wrapped(angle: float) -> float:
    return math.atan2(math.sin(angle), math.cos(angle))
