"""A running Stage world, or many copies of it in step."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.closing import Closeable
from gazelle.description import StageWorld, World
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.reckoning import Reckoning
from gazelle.errors import SimulationError, did_you_mean
from gazelle.formats.stage.building import no_garbage
from gazelle.native.loop import SystemLoop
from gazelle.native.system import System
from gazelle.simulation.clock import Clock
from gazelle.simulation.requests import RequestQueue
from gazelle.simulation.stage.controllers import FleetController, make_controllers
from gazelle.simulation.stage.devices import Devices
from gazelle.simulation.stage.layout import StageRobot, layout_of
from gazelle.simulation.stage.odometry import Odometry
from gazelle.simulation.stage.opening import stage_of
from gazelle.simulation.stage.rangers import Rangers
from gazelle.simulation.stage.senses import Senses
from gazelle.simulation.stage.steering import Steering
from gazelle.streams import seed_of

Listener = Callable[[], None]

_PIECE = 16_384
"""Moves of robots made without a look at what other threads want."""


class StageSimulation(Senses, Closeable):
    """Stage's robots in the planar engine: commands in, poses, odometry and scans out.

    Robots are the top-level position models in file order; all arrays have the axes
    (nworld, nrobot, ...). All that changes the state from another thread goes through
    ``requests``.

    Args:
        world: What a Stage file says, or the file.
        nworld: Copies.
        seed: Decides all random numbers; world i's do not depend on ``nworld``.
        threads: Native threads; all processors if None. Results do not depend on it.
        euler: Move as Stage does, straight ahead and then turning, not along the exact arc.
        sweep: Look for what is in the way within a step too, so that fast robots jump over nothing.
        controllers: Whether the controllers that the file names (``wander``, ``lasernoise``)
            run.

    Attributes:
        stage: What the file says.
        robots: In file order.
        things: Models that grippers can take, in file order; none without grippers.
        fleet: The engine.
        clock: Simulated time.
        requests: Where other threads have things done, between two steps.
        paused: Whether ``run`` waits.
        fans: Beams of each scanner.
        mounts: Where its sensors are.
        noise: Of the sensors of each scanner.
        devices: Grippers and actuators.

    Raises:
        FormatError: The file cannot be read, or is not Stage's.
        EngineError: The world cannot be simulated.
    """

    def __init__(
        self,
        world: StageWorld | World | str | Path,
        *,
        nworld: int = 1,
        seed: int = 0,
        threads: int | None = None,
        euler: bool = False,
        sweep: bool = False,
        controllers: bool = True,
    ) -> None:
        self.stage = stage_of(world)
        self.seed, self.nworld = seed_of(seed), nworld
        with no_garbage():
            layout = layout_of(self.stage)
            self.fleet = Fleet(
                layout.bodies,
                () if layout.statics is None else layout.statics,
                nworld=nworld,
                time_step=self.stage.interval_sim,
                euler=euler,
                sweep=sweep,
                threads=threads,
            )
        self.robots, self.things = tuple(layout.robots), tuple(layout.things)
        self._own = slice(0, len(self.robots))  # of the bodies; things come after robots
        self._names = {robot.name: robot for robot in self.robots}
        self.clock = Clock(self.stage.interval_sim)
        self.requests = RequestQueue()
        self.paused = self.stage.paused
        self._rangers = Rangers(self.fleet, layout, seed)
        self.fans, self.mounts = layout.fans, layout.mounts
        self.noise = self._rangers.noise
        self._odometry = Odometry(layout.robots, nworld, seed, euler=euler)
        self._steering = Steering(self.robots)
        self._now = self.poses
        self._before = self._now.copy()
        self._listeners: list[Listener] = []
        self.devices = Devices(self)
        self._controllers: list[FleetController] = make_controllers(self) if controllers else []
        self._piece = max(1, _PIECE // max(1, nworld * len(self.robots)))
        self._moving = self.fleet.systems()
        self._reckoning: Reckoning | None = None
        if self._odometry.needed and not self._steering.needed:
            self._reckoning = self._odometry.system(self.fleet.velocity, self.time_step)
        self._loop: SystemLoop | None = None
        self._closed = False

    # -- what there is -----------------------------------------------------------------

    @property
    def time_step(self) -> float:
        """Of a step [s]: the world's ``interval_sim``."""
        return self.stage.interval_sim

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self.clock.now

    @property
    def steps(self) -> int:
        """Number of steps since the start."""
        return self.clock.now_ns // self.clock.step_ns

    def robot(self, name: str) -> StageRobot:
        """A robot by the name that the file gives it.

        Raises:
            SimulationError: There is none.
        """
        found = self._names.get(name)
        if found is None:
            raise SimulationError(
                f"there is no robot '{name}'", hint=did_you_mean(name, self._names)
            )
        return found

    @property
    def thing_poses(self) -> Floats:
        """x, y [m] and heading [rad] of the things, shape (nworld, nthing, 3); to be read."""
        first = len(self.robots)
        return self.fleet.pose[:, first : first + len(self.things)]

    @property
    def commands(self) -> Floats:
        """Wanted velocities x, y [m/s] and yaw [rad/s], to be written, shape (nworld, nrobot, 3).

        Those of a car are its speed, nothing, and its steering angle [rad].
        """
        return self.fleet.command[:, self._own]

    @property
    def poses(self) -> Floats:
        """True x, y [m] and heading [rad], shape (nworld, nrobot, 3); to be read."""
        return self.fleet.pose[:, self._own]

    @property
    def velocities(self) -> Floats:
        """Of the drives in the robots' frames: x, y [m/s], yaw [rad/s]; also while stalled."""
        return self._steering.velocities(self.fleet.velocity[:, self._own])

    @property
    def true_velocities(self) -> Floats:
        """How the poses changed in the last step, in the world's axes [m/s, rad/s]."""
        change = np.subtract(self.poses, self._before)
        change[..., 2] = np.arctan2(np.sin(change[..., 2]), np.cos(change[..., 2]))
        rate: Floats = change / self.time_step
        return rate

    @property
    def odometry(self) -> Floats:
        """Where the robots believe they are, by their ``localization``; as ``poses``."""
        if not self._odometry.needed:
            return self.poses
        used = self._odometry.used[None, :, None]
        found: Floats = np.where(used, self._odometry.pose, self.poses)
        return found

    @property
    def stalled(self) -> NDArray[np.bool_]:
        """Whether a robot's last move was not made, as it would have hit something."""
        return self.fleet.stalled[:, self._own]

    # -- rangers -----------------------------------------------------------------------

    @property
    def scanners(self) -> int:
        """Number of scanners: groups of sensors with the same beams."""
        return len(self.fans)

    def scan(self, scanner: int = 0) -> Floats:
        """What all sensors of a scanner measure now [m], shape (nworld, sensors, samples).

        ``Ranger.places`` says which scanner and which row are a sensor's. Each is measured
        once a step, however often it is asked for.

        Args:
            scanner: Its index.

        Raises:
            SimulationError: There is no such scanner.
        """
        return self._rangers.scan(scanner)

    def scan_system(self, scanner: int) -> tuple[System, Floats] | None:
        """What scans in native code, and where it writes, a row a sensor; None if that is not all.

        Raises:
            SimulationError: There is no such scanner.
        """
        return self._rangers.system(scanner)

    def scan_of(self, name: str, ranger: int = 0, sensor: int = 0, world: int = 0) -> Floats:
        """What one sensor of a robot measures now [m], shape (samples,).

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
        found: Floats = self.scan(scanner)[world, place].copy()
        return found

    def returns(self, scanner: int, place: int, world: int = 0) -> Floats:
        """``ranger_return`` of what each beam of a sensor meets now; 0 for nothing."""
        return self._rangers.returns(scanner, place, world)

    def _forget(self) -> None:
        """Something moved: what was seen is seen no longer."""
        self._rangers.forget()
        self.forget_views()

    # -- time --------------------------------------------------------------------------

    def step(self, count: int = 1) -> None:
        """Advance by steps of ``interval_sim``, also while paused.

        Raises:
            SimulationError: The simulation is closed, or ``count`` is negative.
        """
        if self._closed:
            raise SimulationError("the simulation is closed")
        if count < 0:
            raise SimulationError(f"cannot go back by {-count} steps")
        with self.requests.lock:
            self.requests.drain()
            while count > 0:
                count -= self._advance(min(count, self._piece))
                self.requests.drain()

    def step_on(self) -> bool:
        """Make one step unless there is a pause; whether it was made.

        Once a request that pauses is answered, this makes no more.

        Raises:
            SimulationError: The simulation is closed.
        """
        with self.requests.lock:
            self.requests.drain()
            if self.paused:
                return False
            self.step()
            return True

    def _advance(self, most: int) -> int:
        """Make at most so many steps, at least one; how many."""
        leapt = self._leap(most - 1)
        for controller in self._controllers:
            controller.update()
        np.copyto(self._before, self._now)
        self.fleet.step()
        if self._odometry.needed:
            self._reckon()
        if self.devices:
            self.devices.update(self.time_step)
        self.clock.advance(leapt + 1)
        self._forget()
        if self._listeners:
            for listener in tuple(self._listeners):
                listener()
        return leapt + 1

    def _reckon(self) -> None:
        """Let robots add what their wheels say of a step to where they believe they are."""
        reckoning = self._reckoning
        if reckoning is None:  # where cars steer, velocities are worked out anew for each step
            reckoning = self._odometry.system(self.velocities, self.time_step)
        reckoning.reckon()

    def _leap(self, count: int) -> int:
        """Make so many steps without Python, or none if it has a part in each; how many."""
        if count < 1 or self._listeners or self.devices:
            return 0
        if not self._controllers and not self._odometry.needed:
            self.fleet.step(count)
            return count
        systems = self._systems()
        if systems is None:
            return 0
        if self._loop is None or self._loop.systems != systems:
            self._loop = SystemLoop(systems, self.nworld, 1, self.fleet.pool)
        self._loop.time = self.steps
        self._loop.run(self.steps + count, self.fleet.threads)
        self._forget()
        return count

    def _systems(self) -> list[System] | None:
        """What a step comes to in native code; None if that is not all."""
        if self._odometry.needed and self._steering.needed:
            return None
        systems: list[System] = []
        for controller in self._controllers:
            its = controller.systems()
            if its is None:
                return None
            systems += its
        systems += self._moving
        return systems if self._reckoning is None else [*systems, self._reckoning]

    def run(self, seconds: float, *, rate: float | None = None) -> None:
        """Advance by simulated time.

        Args:
            seconds: How long [s].
            rate: Simulated seconds a wall second at most; None for as fast as possible.
        """
        count, start = self.clock.steps_in(seconds), time.monotonic()
        if rate is None:
            self.step(count)
            return
        for done in range(1, count + 1):  # steps are long: each has a time of its own
            self.step()
            ahead = start + done * self.time_step / rate - time.monotonic()
            if ahead > 0.0:
                time.sleep(ahead)

    def pause(self) -> None:
        """Let those who keep it running wait; ``step`` still steps."""
        self.paused = True

    def unpause(self) -> None:
        """Go on."""
        self.paused = False

    def subscribe(self, listener: Listener) -> Callable[[], None]:
        """Have something called after every step, between two steps; returns what ends it."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener) if listener in self._listeners else None

    # -- changes -----------------------------------------------------------------------

    def set_pose(self, name: str, pose: ArrayLike, worlds: Worlds | None = None) -> None:
        """Put a robot somewhere, whatever is there; its odometry does not notice.

        Args:
            name: Of the robot.
            pose: x, y [m] and heading [rad], shape (3,) or (n, 3).
            worlds: Which worlds; all if None.

        Raises:
            SimulationError: There is no such robot, or a value is not finite.
        """
        self.set_pose_of(self.robot(name).index, pose, worlds)

    def set_pose_of(self, index: int, pose: ArrayLike, worlds: Worlds | None = None) -> None:
        """The same for a robot by its index.

        Raises:
            SimulationError: A value is not finite.
        """
        values = np.asarray(pose, np.float64)
        if not np.isfinite(values).all():
            name = self.robots[index].name
            raise SimulationError(f"the pose of '{name}' is not finite: {values}")
        self.fleet.place(index, values, worlds)
        rows = slice(None) if worlds is None else worlds
        self.fleet.stalled[rows, index] = False
        self._before[rows, index] = self.fleet.pose[rows, index]
        self.devices.follow(index)
        self._forget()

    def reset_positions(self, worlds: Worlds | None = None) -> None:
        """Put all robots back to where they were at first, standing, their odometry at zero."""
        self.fleet.reset(worlds)
        self._odometry.reset(worlds)
        rows = slice(None) if worlds is None else worlds
        self._before[rows] = self.poses[rows]
        self.devices.reset(worlds)
        self._forget()

    def reset(self) -> None:
        """Start over: robots, time, and random numbers."""
        self.reset_positions()
        self._rangers.rewind()
        for controller in self._controllers:
            controller.reset()
        self.clock.now_ns = 0

    def close(self) -> None:
        """End the threads of the engine."""
        self._closed = True
        self.fleet.close()

    @property
    def named(self) -> Mapping[str, StageRobot]:
        """The robots by name; of several of one name the last."""
        return self._names
