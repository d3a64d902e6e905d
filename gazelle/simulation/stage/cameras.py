"""Stage's cameras: what they see, drawn when somebody asks."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from gazelle.array_types import Worlds
from gazelle.description import PlacedStageModel, StageCamera, StageModel, StagePose
from gazelle.engines.planar.pictures import CameraMount, CameraPictures, Lens, Painter
from gazelle.engines.planar.stage_layout import StageRobot
from gazelle.errors import SimulationError
from gazelle.simulation.stage.scenery import scenery_of

if TYPE_CHECKING:
    from gazelle.simulation.stage.senses import Senses


@dataclass(frozen=True, slots=True)
class MountedCamera:
    """A camera on a robot.

    Attributes:
        name: Its own name in the file.
        path: Its name on the robot, with those of what it is mounted on.
        device: What the file says.
        pose: In the body's frame, its height included; its heading without the pan.
        direct: Whether it is mounted on the robot itself.
        body: Index of the body that it is on: the robot, or what an actuator moves.
        owner: Which of the models on that it is, depth first.
    """

    name: str
    path: str
    device: StageCamera
    pose: StagePose
    direct: bool
    body: int
    owner: int

    @property
    def lens(self) -> Lens:
        """Its pixels, field of view and range."""
        return Lens(*self.device.resolution, self.device.fov, *self.device.range)

    @property
    def view(self) -> CameraMount:
        """Where it is on its body: as in Stage a pan is to the right, and a tilt down."""
        pan, tilt = self.device.pantilt
        x, y, z, yaw = self.pose
        return CameraMount(self.body, x, y, z, yaw - pan, tilt, self.owner)


class Cameras:
    """All cameras of a world; pictures are drawn once a step, however often they are asked for.

    Args:
        simulation: Runs.
        models: Of all moving bodies.
    """

    def __init__(self, simulation: Senses, models: list[StageModel]) -> None:
        self._simulation = simulation
        self._painter = Painter(simulation.fleet, scenery_of(simulation.still, models))
        self._seen: dict[tuple[int, int, int], CameraPictures] = {}
        self._changes = -1

    def picture(self, robot: int, which: int, world: int) -> CameraPictures:
        """What one camera sees, shape (height, width, ...).

        Raises:
            SimulationError: The robot has no camera of this number.
        """
        changes = self._simulation.fleet.changes
        if self._changes != changes:  # something moved
            self._changes = changes
            self._seen.clear()
        key = (robot, which, world)
        if key not in self._seen:
            many = self.pictures([robot], which, np.array([world]))
            self._seen[key] = CameraPictures(many.color[0, 0], many.depth[0, 0])
        return self._seen[key]

    def pictures(self, robots: list[int], which: int, worlds: Worlds) -> CameraPictures:
        """What the cameras of a number see, shape (worlds, robots, height, width, ...).

        Raises:
            SimulationError: A robot has no camera of this number, or they differ in their lens.
        """
        found = [self._camera(robot, which) for robot in robots]
        lenses = {camera.lens for camera in found}
        if len(lenses) != 1:
            raise SimulationError(
                "only cameras with the same resolution, range and fov make one array",
                hint="ask for their pictures one by one",
            )
        views = [camera.view for camera in found]
        return self._painter.draw(lenses.pop(), views, worlds)

    def _camera(self, robot: int, which: int) -> MountedCamera:
        own = self._simulation.robots[robot]
        found = cameras_of(own)
        if not 0 <= which < len(found):
            raise SimulationError(f"'{own.name}' has {len(found)} cameras, no number {which}")
        return found[which]


def cameras_of(robot: StageRobot) -> tuple[MountedCamera, ...]:
    """The cameras on a robot, in file order; those on actuators last."""
    own = robot.model.name.removeprefix("/")
    return tuple(
        MountedCamera(
            placed.model.name,
            placed.name.removeprefix(f"{own}."),
            device,
            placed.pose,
            direct=body == robot.index and _is_direct(placed),
            body=body,
            owner=owner,
        )
        for body, model in robot.bodies
        for owner, placed in enumerate(replace(model, pose=StagePose()).walk())
        if (device := placed.model.device_of(StageCamera)) is not None
    )


def _is_direct(placed: PlacedStageModel) -> bool:
    return placed.parent is not None and placed.parent.parent is None
