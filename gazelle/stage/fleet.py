"""All robots of Stage files in a simulation, as arrays."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.argument_checks import checked, indices
from gazelle.array_types import Floats, Worlds
from gazelle.engines.planar import Fan, Fleet, Mount, PlanarEngine
from gazelle.errors import SimulationError, did_you_mean
from gazelle.native.system import System
from gazelle.simulation.clock import Clock
from gazelle.simulation.inputs import chosen, finite, one_world, size_of
from gazelle.simulation.state_lock import StateLock
from gazelle.stage.description import StageModel, StageWorld, stage_world
from gazelle.stage.devices import Devices
from gazelle.stage.drive_state import DriveState
from gazelle.stage.fleet_controller import FleetController
from gazelle.stage.layout import stage_layout
from gazelle.stage.measured_odometry import MeasuredOdometry
from gazelle.stage.rangers import Rangers
from gazelle.stage.robots import StageRobot, warn_of_mounted_drives
from gazelle.stage.scans import StageRangeNoise
from gazelle.stage.stage_devices import StageDevices


@checked(SimulationError)
class StageFleet(StageDevices):
    """Commands, poses, odometry and scans of all robots of Stage files: ``Simulation.extension(StageFleet)``.

    All arrays have the axes (nworld, nrobot, ...); robots are in the order of the world's models.
    They are views of what runs: other threads than the one that steps hold ``Simulation.lock``.

    Args:
        engine: Moves them.
        clock: Of the simulation.
        lock: Of the simulation.
        seed: The run's seed.
        make_controllers: Makes those that the robots name, at the start and for other robots.

    Attributes:
        clock: Simulated time.
        lock: Of the simulation.
        seed: The run's seed.
        nworld: Copies of the world.
        controllers: Those that the file names.
    """

    def __init__(
        self,
        engine: PlanarEngine,
        clock: Clock,
        lock: StateLock,
        seed: int,
        make_controllers: Callable[[StageFleet], list[FleetController]],
    ) -> None:
        self.engine, self.clock, self.lock, self.seed = engine, clock, lock, seed
        self.nworld, self._make_controllers = engine.nworld, make_controllers
        self.controllers: list[FleetController] = []
        self._revision = -1
        self._bind()
        warn_of_mounted_drives(self._robots)
        self.controllers = self._make_controllers(self)

    # -- what there is -----------------------------------------------------------------

    def refresh(self) -> None:
        """Update the robots after models changed."""
        if self._revision != self.engine.revision:
            before = self._robots, self._rangers, self._motion, self._devices, self._things
            self._bind()
            robots, rangers, motion, devices, things = before
            pairs = _pairs([r.name for r in robots], [r.name for r in self._robots])
            self._rangers.copy_from(rangers)
            self._motion.copy_from(motion, pairs)
            kept = dict(_pairs([t.name for t in things], [t.name for t in self._things]))
            self._devices.copy_from(devices, pairs, kept)
            if [r.name for r in robots] == [r.name for r in self._robots]:
                for controller in self.controllers:
                    controller.rebind()
            else:
                self.controllers = self._make_controllers(self)

    def _bind(self) -> None:
        """Look up the models that the engine has now."""
        self._revision = self.engine.revision
        layout, fleet = stage_layout(self.engine), self.engine.fleet
        self._fleet = fleet
        self._robots, self._things = tuple(layout.robots), tuple(layout.things)
        self._still, self._placed = layout.still, layout.placed
        self._named = {robot.name: robot for robot in self._robots}
        own = slice(0, len(self._robots))
        self._commands, self._poses = fleet.command[:, own], fleet.pose[:, own]
        self._driven, self._stalled = fleet.velocity[:, own], fleet.stalled[:, own]
        self._rangers = Rangers(fleet, layout.fans, layout.mounts, layout.noises, self.seed)
        self._motion = DriveState(self._robots, fleet, self.seed)
        self._devices = Devices(self)
        self._measured = MeasuredOdometry(
            self._robots, fleet, self.clock, lambda: (self.odometry, self.velocities)
        )
        self.forget_views()

    @property
    def description(self) -> StageWorld:
        """Description of the world in the file."""
        return stage_world(self.engine.world) or StageWorld()

    @property
    def fleet(self) -> Fleet:
        """The bodies in the plane; another one when models came or went."""
        self.refresh()
        return self._fleet

    @property
    def robots(self) -> tuple[StageRobot, ...]:
        """The models that drive, in the order of the world's models."""
        self.refresh()
        return self._robots

    @property
    def things(self) -> tuple[StageModel, ...]:
        """Models that grippers can take, in file order; none without grippers."""
        self.refresh()
        return self._things

    @property
    def still(self) -> Sequence[StageModel]:
        """Models that never move."""
        self.refresh()
        return self._still

    @property
    def placed(self) -> Sequence[StageModel]:
        """Kinematic models."""
        self.refresh()
        return self._placed

    @property
    def devices(self) -> Devices:
        """Grippers and actuators."""
        self.refresh()
        return self._devices

    @property
    def named(self) -> Mapping[str, StageRobot]:
        """The robots by name."""
        self.refresh()
        return self._named

    def robot(self, name: str) -> StageRobot:
        """Return a robot by its name.

        Raises:
            SimulationError: There is none.
        """
        found = self.named.get(name)
        if found is None:
            raise SimulationError(
                f"there is no robot '{name}'", hint=did_you_mean(name, self._named)
            )
        return found

    # -- time --------------------------------------------------------------------------

    @property
    def time_step(self) -> float:
        """Time step [s]: the world's ``interval_sim``."""
        return self.engine.time_step

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self.clock.now

    @property
    def steps(self) -> int:
        """Number of steps since the start."""
        return self.clock.now_ns // self.clock.step_ns

    # -- motion ------------------------------------------------------------------------

    @property
    def thing_poses(self) -> Floats:
        """x, y [m] and heading [rad] of the objects, shape (nworld, nthing, 3); to be read."""
        poses, first = self.fleet.pose, len(self._robots)
        return poses[:, first : first + len(self._things)]

    @property
    def commands(self) -> Floats:
        """Wanted velocities x, y [m/s] and yaw [rad/s], to be written, shape (nworld, nrobot, 3).

        Those of a car are its speed, nothing, and its steering angle [rad].
        """
        self.refresh()
        return self._commands

    @property
    def poses(self) -> Floats:
        """True x, y [m] and heading [rad], shape (nworld, nrobot, 3); to be read."""
        self.refresh()
        return self._poses

    @property
    def velocities(self) -> Floats:
        """Velocities of drives in the robots' frames: x, y [m/s], yaw [rad/s].

        Also while stalled.
        """
        self.refresh()
        return self._motion.steering.velocities(self._driven)

    @property
    def true_velocities(self) -> Floats:
        """Change of the poses in the last step, in the world's axes [m/s, rad/s]."""
        change = np.subtract(self.poses, self._motion.before)
        change[..., 2] = np.arctan2(np.sin(change[..., 2]), np.cos(change[..., 2]))
        rate: Floats = change / self.time_step
        return rate

    @property
    def odometry(self) -> Floats:
        """Poses of the robots by their ``localization``; as ``poses``."""
        poses, odometry = self.poses, self._motion.odometry
        if not odometry.needed:
            return poses
        found: Floats = np.where(odometry.used[None, :, None], odometry.pose, poses)
        return found

    @property
    def measured_odometry(self) -> MeasuredOdometry:
        """Odometry of each robot as a value."""
        self.refresh()
        return self._measured

    @property
    def stalled(self) -> NDArray[np.bool_]:
        """True for robots whose last move was blocked by an obstacle."""
        self.refresh()
        return self._stalled

    @property
    def bumped(self) -> NDArray[np.bool_]:
        """True for robots with a blocked move since this was last set to False; writable.

        Recording starts at the first access.
        """
        self.refresh()
        return self._motion.watch()

    # -- rangers -----------------------------------------------------------------------

    @property
    def rangers(self) -> Rangers:
        """All rangers, by scanner: a group of sensors with the same beams."""
        self.refresh()
        return self._rangers

    @property
    def scanners(self) -> int:
        """Number of scanners: groups of sensors with the same beams."""
        return len(self.rangers.fans)

    @property
    def fans(self) -> list[Fan]:
        """Beams of each scanner."""
        return self.rangers.fans

    @property
    def mounts(self) -> list[list[Mount]]:
        """Mounts of its sensors."""
        return self.rangers.mounts

    @property
    def noise(self) -> list[StageRangeNoise]:
        """Noise of the sensors of each scanner."""
        return self.rangers.noise

    def scan(self, scanner: int = 0) -> Floats:
        """Return the present ranges of all sensors of a scanner [m], shape (nworld, sensors, samples).

        ``Ranger.places`` says which scanner and which row are a sensor's. Each is measured
        once a step, however often it is requested.

        Args:
            scanner: Its index.

        Raises:
            SimulationError: There is no such scanner.
        """
        return self.rangers.scan(scanner)

    def scan_system(self, scanner: int) -> tuple[System, Floats] | None:
        """Return the native scan system and its output, a row a sensor; None if Python takes part.

        Raises:
            SimulationError: There is no such scanner.
        """
        return self.rangers.system(scanner)

    def scan_of(self, name: str, ranger: int = 0, sensor: int = 0, world: int = 0) -> Floats:
        """Return the present ranges of one sensor of a robot [m], shape (samples,).

        Raises:
            SimulationError: There is no such robot, ranger or sensor.
        """
        robot = self.robot(name)
        try:
            scanner, place = robot.rangers[ranger].places[sensor]
        except IndexError:
            raise SimulationError(
                f"'{name}' has no ranger {ranger} with a sensor {sensor}"
            ) from None
        found: Floats = self.scan(scanner)[one_world(world, self.nworld), place].copy()
        return found

    def returns(self, scanner: int, place: int, world: int = 0) -> Floats:
        """Return ``ranger_return`` of what each beam of a sensor meets now; 0 for nothing."""
        return self.rangers.returns(scanner, place, one_world(world, self.nworld))

    # -- changes -----------------------------------------------------------------------

    def set_pose(self, name: str, pose: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set the pose of a robot, regardless of obstacles; its odometry does not notice.

        It keeps its command, unlike with ``Robot.set_pose``.

        Args:
            name: Of the robot.
            pose: x, y [m] and heading [rad], shape (3,) or (n, 3).
            worlds: Worlds; all if None.

        Raises:
            SimulationError: There is no such robot, or a value is not finite.
        """
        self.set_pose_of(self.robot(name).index, pose, worlds)

    def set_pose_of(self, index: int, pose: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set the pose of a robot by its index.

        Raises:
            SimulationError: There is no such robot, or a value is not finite.
        """
        if not 0 <= index < len(self.robots):
            raise SimulationError(f"there is no robot {index} of {len(self.robots)}")
        some = chosen(worlds, self.nworld)
        count = size_of(some, self.nworld)
        values = finite(f"the pose of '{self.robots[index].name}'", pose, 3, count)
        self.refresh()
        self.engine.place_body(index, values, some)
        rows = slice(None) if some is None else some
        self._motion.before[rows, index] = self.poses[rows, index]
        self._devices.follow(index)

    def place(self, rows: Worlds, poses: ArrayLike) -> None:
        """Set the poses of many robots, at rest, regardless of obstacles.

        Args:
            rows: Rows, as world * nrobot + robot, shape (n,).
            poses: x, y [m] and heading [rad], shape (n, 3).

        Raises:
            SimulationError: There is no such robot, or a value is not finite.
        """
        count = len(self.robots)
        which = indices("rows", rows, self.nworld * count, SimulationError)
        values = np.broadcast_to(finite("the poses", poses, 3, len(which)), (len(which), 3))
        worlds, robots = np.divmod(which, max(count, 1))
        self.engine.place_bodies(worlds * self._fleet.nbody + robots, values)
        self._motion.before[worlds, robots] = self.poses[worlds, robots]
        for robot in np.unique(robots).tolist() if self._devices else ():
            self._devices.follow(robot)

    def reset_positions(self, worlds: Worlds | None = None) -> None:
        """Reset all robots to their initial poses, at rest, their odometry at zero."""
        self.refresh()
        some = chosen(worlds, self.nworld)
        self.engine.reset(some)
        self.start_over(some)

    def start_over(self, worlds: Worlds | None = None) -> None:
        """Reset odometry and devices, after the engine's reset."""
        self._motion.reset(worlds)
        self._devices.reset(worlds)

    # -- for the simulation ------------------------------------------------------------

    @property
    def motion(self) -> DriveState:
        """Odometry, and where bodies were before the step."""
        self.refresh()
        return self._motion


def _pairs(old: Sequence[str], new: Sequence[str]) -> list[tuple[int, int]]:
    """Return the old and the new index of each name that is in both lists."""
    places = {name: index for index, name in enumerate(new)}
    return [(index, places[name]) for index, name in enumerate(old) if name in places]
