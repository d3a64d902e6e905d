"""Stage's cameras: pictures, rendered on demand."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.errors import SimulationError
from gazelle.rendering import PinholeLens, Renderer, plain_surroundings
from gazelle.stage.description import (
    PlacedStageModel,
    StageCamera,
    StageModel,
    StagePose,
)
from gazelle.stage.robots import StageRobot
from gazelle.stage.scenery import SKY, scenery_of
from gazelle.stage.stage_bodies import StageBodies


@dataclass(frozen=True, slots=True)
class CameraPictures:
    """Images of some cameras.

    Attributes:
        color: Red, green, blue and 255, bytes, shape (..., height, width, 4), top row first.
        depth: Along the optical axis [m], infinite where nothing is, shape (..., height, width).
    """

    color: NDArray[np.uint8]
    depth: NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class MountedCamera:
    """A camera on a robot.

    Attributes:
        name: Its own name in the file.
        path: Its name on the robot, with those of what it is mounted on.
        device: Settings of the file.
        pose: In the body's frame, its height included; its heading without the pan.
        direct: Whether it is mounted on the robot itself.
        body: Index of the body that it is on: the robot, or what an actuator moves.
        owner: Index of its model, depth first.
    """

    name: str
    path: str
    device: StageCamera
    pose: StagePose
    direct: bool
    body: int
    owner: int

    @property
    def lens(self) -> PinholeLens:
        """Lens with pixels, fields of view and range."""
        wide, high = self.device.fov
        return PinholeLens(*self.device.resolution, wide, *self.device.range, vertical_fov=high)

    @property
    def mount(self) -> tuple[float, float, float, float, float]:
        """x, y, z [m], heading and tilt [rad] on its body: as in Stage a pan is to the right."""
        pan, tilt = self.device.pantilt
        x, y, z, yaw = self.pose
        return x, y, z, yaw - pan, tilt


class Cameras:
    """All cameras of a world; pictures are drawn once a step, however often they are asked for.

    Args:
        simulation: Runs.
        models: Of all moving bodies.
    """

    def __init__(self, simulation: StageBodies, models: list[StageModel]) -> None:
        self._simulation = simulation
        self._scenery = scenery_of(simulation.still, models)
        self._renderer = Renderer(
            plain_surroundings(SKY),
            nworld=simulation.nworld,
            threads=simulation.fleet.pool.size,
            seen=self._scenery.seen,
        )
        self._seen: dict[tuple[int, int, int], CameraPictures] = {}
        self._mounted: dict[int, tuple[MountedCamera, ...]] = {}
        self._changes = -1
        self._placed = np.zeros(simulation.nworld, np.bool_)

    def picture(self, robot: int, which: int, world: int) -> CameraPictures:
        """Return the image of one camera, shape (height, width, ...).

        Raises:
            SimulationError: The robot has no camera of this number.
        """
        self.draw([(robot, which, world)])
        return self._seen[robot, which, world]

    def draw(self, cameras: Iterable[tuple[int, int, int]]) -> None:
        """Render the cameras that ``picture`` will need, all with the same lens at once.

        Args:
            cameras: Robots, numbers of cameras on them, and worlds.

        Raises:
            SimulationError: A robot has no camera of this number.
        """
        self._forget_what_moved()
        late: defaultdict[PinholeLens, list[tuple[int, int, int]]] = defaultdict(list)
        for key in cameras:
            if key not in self._seen:
                late[self._camera(*key[:2]).lens].append(key)
        for lens, keys in late.items():
            views = self._views([self._camera(robot, which) for robot, which, _ in keys])
            seen = self._draw(lens, views, np.array([world for *_, world in keys]))
            for key, color, depth in zip(keys, seen.color, seen.depth, strict=True):
                self._seen[key] = CameraPictures(color, depth)

    def pictures(self, robots: list[int], which: int, worlds: Worlds) -> CameraPictures:
        """Return the images of the cameras of a number, shape (worlds, robots, height, width, ...).

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
        self._forget_what_moved()
        views = np.tile(self._views(found), (len(worlds), 1))
        seen = self._draw(lenses.pop(), views, np.repeat(worlds, len(found)))
        shape = (len(worlds), len(found), *seen.depth.shape[1:])
        return CameraPictures(seen.color.reshape(*shape, 4), seen.depth.reshape(shape))

    def _views(self, cameras: list[MountedCamera]) -> Floats:
        """Return body, place [m], heading and tilt [rad] on it, and hidden link, shape (n, 7)."""
        casings = self._scenery.casings
        return np.array([(v.body, *v.mount, casings[v.body, v.owner]) for v in cameras])

    def _draw(self, lens: PinholeLens, views: Floats, worlds: Worlds) -> CameraPictures:
        """Render views, one a row, in worlds, one each."""
        self._place(np.unique(worlds))
        body, x, y, z, yaw, tilt, unseen = views.T
        bodies = body.astype(np.int64)
        place, heading = self._poses(worlds, bodies)
        cos, sin = self._simulation.fleet.directions[worlds, bodies].T
        offset = np.stack((cos * x - sin * y, sin * x + cos * y, z), axis=1)
        frames = self._renderer.render(
            lens,
            place + offset,
            _turned(heading + yaw, tilt),
            worlds,
            want=("color", "depth"),
            unseen=unseen.astype(np.int64),
            channels=4,
        )
        return CameraPictures(frames.color, frames.depth)

    def _forget_what_moved(self) -> None:
        changes = self._simulation.fleet.changes
        if self._changes != changes:
            self._changes = changes
            self._seen.clear()
            self._placed[:] = False

    def _place(self, worlds: Worlds) -> None:
        """Set all bodies of some worlds to their present poses."""
        late = worlds[~self._placed[worlds]]
        if len(late):
            place, heading = self._poses(late[:, None], self._scenery.bodies)
            links, turned = self._renderer.links[1:], _turned(heading, np.zeros(1))
            self._renderer.place_all(links, place, turned, late)
            self._placed[late] = True

    def _poses(self, worlds: Worlds, bodies: NDArray[np.int64]) -> tuple[Floats, Floats]:
        """Return x, y, z [m], shape (..., 3), and heading [rad] of bodies in worlds."""
        fleet = self._simulation.fleet
        pose, heights = fleet.pose[worlds, bodies], fleet.heights[worlds, bodies]
        return np.concatenate((pose[..., :2], heights[..., None]), axis=-1), pose[..., 2]

    def _camera(self, robot: int, which: int) -> MountedCamera:
        own = self._simulation.robots[robot]
        found = self._mounted.get(robot) or self._mounted.setdefault(robot, cameras_of(own))
        if not 0 <= which < len(found):
            raise SimulationError(f"'{own.name}' has {len(found)} cameras, no number {which}")
        return found[which]


def cameras_of(robot: StageRobot) -> tuple[MountedCamera, ...]:
    """Return the cameras on a robot, in file order; those on actuators last."""
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


def _turned(heading: Floats, tilt: Floats) -> Floats:
    """Return quaternions x, y, z, w of a heading about z after a downward tilt about y [rad]."""
    cos, sin, level, low = (
        np.cos(heading / 2),
        np.sin(heading / 2),
        np.cos(tilt / 2),
        np.sin(tilt / 2),
    )
    return np.stack((-sin * low, cos * low, sin * level, cos * level), axis=-1)


def _is_direct(placed: PlacedStageModel) -> bool:
    return placed.parent is not None and placed.parent.parent is None
