"""Devices of Stage's robots besides their rangers, read one by one."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable, Sequence
from functools import cached_property

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Worlds
from gazelle.errors import SimulationError
from gazelle.simulation.inputs import chosen, one_world
from gazelle.stage.actuators import Actuator
from gazelle.stage.bumpers import find_bumps
from gazelle.stage.cameras import CameraPictures, Cameras, cameras_of
from gazelle.stage.devices import Devices, pick
from gazelle.stage.finders import (
    Blob,
    Fiducial,
    Surroundings,
    find_blobs,
    find_fiducials,
    models_of,
)
from gazelle.stage.grippers import Gripper
from gazelle.stage.robots import StageRobot
from gazelle.stage.stage_bodies import StageBodies


@checked(SimulationError)
class StageDevices(StageBodies):
    """The devices of robots: sensors and actuators.

    Cameras, bumpers, fiducial and blob finders are made when they are used.
    """

    @property
    @abstractmethod
    def devices(self) -> Devices:
        """Grippers and actuators."""

    @abstractmethod
    def robot(self, name: str) -> StageRobot:
        """Return a robot by the name that the file gives it."""

    @cached_property
    def _around(self) -> Surroundings:
        return Surroundings(self)

    @cached_property
    def _cameras(self) -> Cameras:
        return Cameras(self, models_of(self))

    def _one(self, world: int) -> int:
        return one_world(world, self.nworld)

    def gripper(self, name: str, which: int = 0) -> Gripper:
        """Return a gripper of a robot, in all worlds.

        Raises:
            SimulationError: There is no such robot or gripper.
        """
        return pick(self.devices.grippers, self.robot(name), which, "grippers")

    def actuator(self, name: str, which: int = 0) -> Actuator:
        """Return an actuator of a robot, in all worlds; one on another is fixed there.

        Raises:
            SimulationError: There is no such robot or actuator.
        """
        return pick(self.devices.actuators, self.robot(name), which, "actuators")

    def forget_views(self) -> None:
        """Discard cached views after models changed."""
        for name in ("_cameras", "_around"):
            self.__dict__.pop(name, None)

    def fiducials(self, name: str, finder: int = 0, world: int = 0) -> list[Fiducial]:
        """Return the fiducials that a finder of a robot sees now, nearest first.

        Raises:
            SimulationError: There is no such robot or finder.
        """
        return find_fiducials(self._around, self.robot(name).index, finder, self._one(world))

    def blobs(self, name: str, finder: int = 0, world: int = 0) -> list[Blob]:
        """Return the blobs that a finder of a robot sees now, from left to right.

        Raises:
            SimulationError: There is no such robot or finder.
        """
        return find_blobs(self._around, self.robot(name).index, finder, self._one(world))

    def bumps(self, name: str, bumper: int = 0, world: int = 0) -> tuple[str | None, ...]:
        """Return the whole name of the model that each strip of a bumper touches now, or None.

        Raises:
            SimulationError: There is no such robot or bumper.
        """
        return find_bumps(self._around, self.robot(name).index, bumper, self._one(world))

    def picture(self, name: str, camera: int = 0, world: int = 0) -> CameraPictures:
        """Return the present image of a robot's camera, drawn once a step: colours and depths.

        Args:
            name: Of the robot.
            camera: Number of the camera on it, depth first in file order.
            world: World.

        Returns:
            ``color``, shape (height, width, 4), and ``depth`` [m], shape (height, width).

        Raises:
            SimulationError: There is no such robot or camera.
        """
        return self._cameras.picture(self.robot(name).index, camera, self._one(world))

    def draw(self, cameras: Iterable[tuple[str, int, int]]) -> None:
        """Render at once, by all threads, what ``picture`` will need in this step.

        Args:
            cameras: Names of robots, numbers of cameras on them, and worlds.

        Raises:
            SimulationError: There is no such robot, camera or world.
        """
        rows = list(cameras)
        if not all(isinstance(row, tuple) and len(row) == 3 for row in rows):
            raise SimulationError(f"pictures are of (robot, camera, world), not {rows!r:.60}")
        self._cameras.draw((self.robot(r).index, camera, self._one(w)) for r, camera, w in rows)

    def pictures(
        self,
        names: Sequence[str] | None = None,
        camera: int = 0,
        worlds: Worlds | None = None,
    ) -> CameraPictures:
        """Return the present images of cameras of many robots and worlds, drawn by all threads.

        Args:
            names: Of the robots; all that have such a camera if None.
            camera: As for ``picture``.
            worlds: Worlds; all if None.

        Returns:
            ``color``, shape (worlds, robots, height, width, 4), and ``depth`` [m].

        Raises:
            SimulationError: There is no such robot or camera, or their lenses differ.
        """
        if names is None:
            robots = [r.index for r in self.robots if len(cameras_of(r)) > camera]
        else:
            robots = [self.robot(name).index for name in names]
        some = chosen(worlds, self.nworld)
        every = np.arange(self.nworld) if some is None else some
        return self._cameras.pictures(robots, camera, every)
