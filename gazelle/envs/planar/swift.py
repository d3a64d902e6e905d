"""One robot with two driven wheels and a lidar, stepped in many worlds by native kernels."""

from __future__ import annotations

import math
from dataclasses import dataclass
from operator import is_
from typing import Any, Self

import numpy as np

from gazelle.engines.native import Function
from gazelle.engines.planar import PlanarEngine, Scanner
from gazelle.envs.planar import kernels_drive
from gazelle.envs.planar.parts import (
    Drive,
    Paths,
    Statics,
    caster_of,
    drive_of,
    looks_of,
    paths_of,
    statics_of,
)
from gazelle.envs.planar.tables import Floats, Indices, Worlds
from gazelle.sensors import LidarModel
from gazelle.simulation import Robot
from gazelle.simulation.clock import NANOSECONDS, Clock, Schedule

_SHARE = 128  # worlds that are worth a thread
_VECTOR = 8  # numbers that are handled at once at most
_NOTHING = np.zeros((0, 0))


@dataclass(frozen=True, slots=True)
class _Room:
    """What a thread writes on; see ``kernels_lidar``."""

    found: Floats
    turned: Floats
    order: Indices
    lanes: Floats
    values: Floats


class Swift:
    """Steps a simulation as its plugins and sensors would, all worlds by a few native calls.

    It works on the simulation's own clock, fleet and random numbers; only the wheel speeds and
    the times at which paths began are held here, and ``push`` hands them back.

    Args:
        robot: The one robot with a drive.
        sensor: Name of its lidar.
        period: Of a control step [s].
        cap: Ranges are cut here, and stand for nothing met [m].
        parts: What casts the rays, the drive, and bodies that follow paths.

    Attributes:
        fleet: The bodies of all worlds.
        body: Index of the robot in it.
        angular: The yaw rates of the last step [rad/s], shape (nworld,).
        cleaned: What the lidar reports, fit for a policy [m], shape (nworld, samples).
        starting: What ``kernels_drive.restart`` takes after the world, for a kernel of a step.
    """

    @classmethod
    def of(cls, robot: Robot, sensor: str, period: float, cap: float) -> Self | None:
        """Such a stepper; None if something in the world needs the long way."""
        caster = caster_of(robot, sensor)
        drive = drive_of(robot.simulation, robot)
        paths = paths_of(robot.simulation, robot, period)
        if caster is None or drive is None or paths is None or robot.simulation.loads.any:
            return None
        return cls(robot, sensor, period, cap, (caster.scanner, drive, paths))

    def __init__(
        self,
        robot: Robot,
        sensor: str,
        period: float,
        cap: float,
        parts: tuple[Scanner, Drive, Paths],
    ) -> None:
        simulation = robot.simulation
        engine, model = simulation.engine, robot.sensors[sensor].model
        if not isinstance(engine, PlanarEngine) or not isinstance(model, LidarModel):
            raise TypeError("a Swift is made by Swift.of")
        self._simulation, self._engine, self._lidar = simulation, engine, model
        self.fleet = engine.fleet
        self.nworld = engine.nworld
        self._steps = simulation.clock.steps_in(period)
        lidar = model.lidar
        self._law = np.array(
            [lidar.range_min, lidar.range_max, lidar.quantum, lidar.noise.mean, cap]
        )
        self._everywhere = np.arange(self.nworld)
        self._bind(*parts)

    def _bind(self, scanner: Scanner, drive: Drive, paths: Paths) -> None:
        fleet = self.fleet
        self._scanner, self._drive, self._paths = scanner, drive, paths
        self.body = int(drive.law[0])
        height = float(fleet.rows[self.body, 5] + scanner.mounts[0].z)
        self._statics: Statics = statics_of(fleet, height)
        self._fan = scanner.arguments(0)[3].copy()
        self._fan[2] = self._law[1]
        self._looks = looks_of(fleet)
        spans = self._looks.spans
        most = self._statics.faces.shape[1] + int((spans[:, 1] - spans[:, 0]).sum()) + 1
        pairs = (scanner.fan.count + 1) // 2
        wide = -(-pairs // _VECTOR) * _VECTOR
        self._rooms = [
            _Room(
                np.zeros((9, most)),
                np.zeros((5, most)),
                np.zeros(most, np.int64),
                np.zeros((2, wide)),
                np.zeros(pairs + wide),
            )
            for _ in range(fleet.crew.size)
        ]
        self._initial = fleet.initial.copy()
        self._speeds = np.zeros((self.nworld, 2))
        self._epochs = np.zeros((len(paths.plugins), self.nworld))
        self._last = 0.0
        self._linear, self.angular = np.zeros((2, self.nworld))
        self._intervals, self._moments = np.zeros((2, self._steps))
        self._driving = self._drive_with(drive, paths)
        self._now, self._tickets = np.zeros(1), np.zeros(1, np.int64)
        self.starting = self._start_with()
        self._parts: tuple[Any, ...] | None = None
        self._seen: list[tuple[tuple[Any, ...], tuple[Any, ...]]] = []
        self._ranges = np.zeros((self.nworld, scanner.fan.count))
        self.cleaned = np.zeros_like(self._ranges)
        self.pull()

    # -- stepping ----------------------------------------------------------------------

    def step(self, linear: Floats, angular: Floats, act: Function, *others: Any) -> None:
        """Make a control step everywhere, measure, and do what a task makes of that.

        Args:
            linear: Wanted speed in each world [m/s], shape (nworld,).
            angular: Wanted yaw rate [rad/s], shape (nworld,).
            act: A kernel called by each thread, which takes worlds until none is left: its
                arguments are an array that counts those taken, how many there are, what
                ``kernels_drive.drive``, ``kernels_lidar.see`` and ``kernels_lidar.report``
                take after a range of worlds, as tuples, and the others.
            others: What else it takes.
        """
        self._linear[:], self.angular[:] = linear, angular
        self._plan()
        self._now[0] = self._simulation.clock.now
        self._tickets[0] = 0
        measuring = self._measuring(self._everywhere)
        self.fleet.crew.call(
            lambda part: act(self._tickets, self.nworld, self._driving, *measuring[part], *others),
            self.nworld // _SHARE,
        )

    def measure(self, worlds: Worlds, look: Function, *others: tuple[Any, ...]) -> Floats:
        """What the lidar reports now [m], shape (n, samples); used again by the next call.

        ``look`` is a kernel like ``act`` of ``step``, without the step.
        """
        look(0, len(worlds), *self._measuring(worlds)[0], *others)
        return self.cleaned

    def begin(self, worlds: Worlds) -> None:
        """Put worlds back to their start."""
        self._now[0] = self._simulation.clock.now
        kernels_drive.begin(worlds, self.starting)

    def take_paths(self, worlds: Worlds) -> None:
        """Take over from the plugins when the paths of some worlds began."""
        for row, plugin in zip(self._epochs, self._paths.plugins, strict=True):
            row[worlds] = plugin.state()["epoch"][worlds]

    def _flat_state(self) -> tuple[Floats, Floats, Any]:
        """Commands, velocities and stalls of the fleet, with one row a body of all worlds."""
        fleet = self.fleet
        return (
            fleet.command.reshape(-1, 3),
            fleet.velocity.reshape(-1, 3),
            fleet.stalled.reshape(-1),
        )

    def _drive_with(self, drive: Drive, paths: Paths) -> tuple[Any, ...]:
        """What ``kernels_drive.drive`` takes after the range of worlds."""
        fleet, statics = self.fleet, self._statics
        grid, _, head, follow, cell = fleet.lists()
        command, velocity, stalled = self._flat_state()
        return (
            self._linear, self.angular, drive.law, drive.matrix, self._intervals, self._moments,
            self._speeds, self._epochs, paths.table, paths.points, paths.drift,
            statics.room, statics.corner, fleet.time_step, command, velocity,
            fleet.rows, fleet.goal, stalled, fleet.kinds, fleet.pieces, fleet.corners, grid,
            head, follow, cell, fleet.scene.table.rows, statics.cells, statics.start,
            statics.items, _NOTHING, fleet.arguments(),
        )  # fmt: skip

    def _start_with(self) -> tuple[Any, ...]:
        """What ``kernels_drive.restart`` takes after the world."""
        fleet = self.fleet
        grid, _, head, follow, cell = fleet.lists()
        return (
            self._initial, self._now, self._speeds, self._epochs, *self._flat_state(),
            fleet.rows, fleet.nbody, grid, head, follow, cell,
        )  # fmt: skip

    def _measuring(self, worlds: Worlds) -> list[tuple[tuple[Any, ...], tuple[Any, ...]]]:
        """What ``see`` and ``report`` of ``kernels_lidar`` take after the range, for each thread.

        For all worlds the same tuples as the last time, where they hold the same; for some
        worlds those for one thread.
        """
        noise = self._lidar.noise
        parts = (worlds, *noise.white)
        if worlds is not self._everywhere:
            return [self._measure_with(0, *parts)]
        if self._parts is None or not all(map(is_, parts, self._parts)):
            self._parts = parts
            self._seen = [self._measure_with(room, *parts) for room in range(len(self._rooms))]
        return self._seen

    def _measure_with(
        self, room: int, worlds: Worlds, deviation: Floats, keys: Any, counters: Any
    ) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
        scanner, fleet = self._scanner, self.fleet
        own = scanner.arguments(room)
        own_scan = (
            *own[:3], self._fan, own[4], fleet.widest, *scanner.surroundings(), *own[5:],
            self._ranges, scanner.names,
        )  # fmt: skip
        space, looks = self._rooms[room], self._looks
        seeing = (
            worlds, self._statics.faces, self._statics.discs, looks.sides, looks.rounds,
            looks.spans, space.found, space.turned, space.order,
            *own[:3], self._fan, fleet.kinds, fleet.rows, own[5], self._ranges,
            scanner.names, own_scan,
        )  # fmt: skip
        reporting = (
            worlds, self._ranges, self._law, deviation[:, 0], keys, counters,
            space.lanes, space.lanes.view(np.uint64), space.values, self.cleaned,
        )  # fmt: skip
        return seeing, reporting

    def _plan(self) -> None:
        """Go on with clock and schedules by a control step; when drive and paths are due."""
        clock, drive, paths = self._simulation.clock, self._drive.entry.schedule, self._paths
        self._intervals[:] = self._moments[:] = math.nan
        for step in _due(drive, clock, self._steps):
            now = (clock.now_ns + step * clock.step_ns) / NANOSECONDS
            self._intervals[step], self._last = now - self._last, now
        schedules = [entry.schedule for entry in paths.entries]
        for step in _due(schedules[0] if schedules else None, clock, self._steps):
            self._moments[step] = (clock.now_ns + step * clock.step_ns) / NANOSECONDS
        for schedule in schedules[1:]:
            _due(schedule, clock, self._steps)
        clock.advance(self._steps)

    # -- state -------------------------------------------------------------------------

    def pull(self) -> None:
        """Take over the state of the simulation's plugins."""
        state = self._drive.plugin.state()
        self._speeds[:] = state["speeds"]
        self._last = float(state["last_time"])
        for row, plugin in zip(self._epochs, self._paths.plugins, strict=True):
            row[:] = plugin.state()["epoch"]

    def push(self) -> None:
        """Hand the state back to the simulation's plugins."""
        state = dict(self._drive.plugin.state())
        state["speeds"], state["last_time"] = self._speeds, np.array(self._last)
        self._drive.plugin.restore(state)
        for row, plugin in zip(self._epochs, self._paths.plugins, strict=True):
            plugin.restore({"epoch": row})


def _due(schedule: Schedule | None, clock: Clock, steps: int) -> list[int]:
    """The physics steps from now on at which something is due; its schedule goes on."""
    due: list[int] = []
    if schedule is None:
        return due
    step = 0
    while step < steps:
        step = max(step, -((clock.now_ns - schedule.due_ns) // clock.step_ns))
        if step < steps:
            due.append(step)
            schedule.done(clock.now_ns + step * clock.step_ns)
        step += 1
    return due
