"""One robot with two driven wheels and a lidar, stepped in many worlds by native kernels."""

# ruff: noqa: SLF001  # it does in one go what these parts do one by one, on their own arrays

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Self

import numpy as np

from gazelle.engines.planar import PlanarEngine
from gazelle.envs.planar import kernels_drive, kernels_lidar
from gazelle.envs.planar.parts import (
    Drive,
    Paths,
    Statics,
    caster_of,
    drive_of,
    paths_of,
    statics_of,
)
from gazelle.envs.planar.tables import Floats, Worlds
from gazelle.sensors import LidarModel
from gazelle.simulation import Robot

_SHARE = 128  # worlds that are worth a thread
_NOTHING = np.zeros((0, 0))


class Swift:
    """Steps a simulation as its plugins and sensors would, all worlds by a few native calls.

    It works on the simulation's own clock, fleet and random numbers; only the wheel speeds and
    the times at which paths began are held here, and ``push`` hands them back.

    Args:
        robot: The one robot with a drive.
        sensor: Name of its lidar.
        period: Of a control step [s].
        cap: Ranges are cut here, and stand for nothing met [m].

    Attributes:
        fleet: The bodies of all worlds.
        body: Index of the robot in it.
        cleaned: What the lidar reports, fit for a policy [m], shape (nworld, samples).
    """

    @classmethod
    def of(cls, robot: Robot, sensor: str, period: float, cap: float) -> Self | None:
        """Such a stepper; None if something in the world needs the long way."""
        caster = caster_of(robot, sensor)
        drive = drive_of(robot.simulation, robot)
        paths = paths_of(robot.simulation, robot, period)
        if caster is None or drive is None or paths is None or robot.simulation.loads.any:
            return None
        swift = cls.__new__(cls)
        swift._set_up(robot, sensor, period, cap)
        swift._bind(caster.scanner, drive, paths)
        return swift

    def _set_up(self, robot: Robot, sensor: str, period: float, cap: float) -> None:
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
            [lidar.range_min, lidar.range_max, lidar.range_resolution, lidar.noise.mean, cap]
        )
        self._everywhere = np.arange(self.nworld)

    def _bind(self, scanner: Any, drive: Drive, paths: Paths) -> None:
        fleet = self.fleet
        self._scanner, self._drive, self._paths = scanner, drive, paths
        self.body = int(drive.law[0])
        mounts = scanner._mounts
        height = float(fleet.rows[self.body, 5] + mounts[0, 4])
        self._statics: Statics = statics_of(fleet, height)
        self._fan = scanner._fan.copy()
        self._fan[2] = self._law[1]
        most = self._statics.faces.shape[1] + len(fleet.looks) * fleet.nbody + 1
        even = 2 * ((scanner.fan.count + 1) // 2)
        self._rooms = [
            (np.zeros((9, most)), np.zeros((5, most)), np.zeros(even))
            for _ in range(fleet.crew.size)
        ]
        self._initial = fleet._initial.copy()
        self._speeds = np.zeros((self.nworld, 2))
        self._epochs = np.zeros((len(paths.plugins), self.nworld))
        self._last = 0.0
        self._ranges = np.zeros((self.nworld, scanner.fan.count))
        self.cleaned = np.zeros_like(self._ranges)
        self.pull()

    # -- stepping ----------------------------------------------------------------------

    def step(self, linear: Floats, angular: Floats, then: Callable[[int, int], None]) -> Floats:
        """Make a control step everywhere, and measure.

        Args:
            linear: Wanted speed in each world [m/s], shape (nworld,).
            angular: Wanted yaw rate [rad/s], shape (nworld,).
            then: Called by each thread when the worlds first to last - 1 are measured.

        Returns:
            What the lidar reports [m], shape (nworld, samples); used again by the next step.
        """
        intervals, moments = self._timetable()
        fleet = self.fleet
        drive, paths, statics = self._drive, self._paths, self._statics
        own = fleet.arguments()
        grid, _, head, follow, cell = fleet._lists()

        def work(first: int, last: int, part: int) -> None:
            kernels_drive.drive(
                first, last, linear, angular, drive.law, drive.matrix, intervals, moments,
                self._speeds, self._epochs, paths.table, paths.points, paths.drift,
                statics.room, statics.corner, fleet.time_step, fleet._command, fleet._velocity,
                fleet.rows, fleet._goal, fleet._stalled, fleet.kinds, fleet.pieces, fleet.corners, grid, head, follow, cell,
                fleet.scene.table.rows, statics.cells, statics.start, statics.items, _NOTHING, own,
            )  # fmt: skip
            self._measure(first, last, part, self._everywhere)
            then(first, last)

        fleet.crew.share(work, self.nworld, _SHARE)
        return self.cleaned

    def measure(self, worlds: Worlds) -> Floats:
        """What the lidar reports now [m], shape (n, samples); used again by the next call."""
        self._measure(0, len(worlds), 0, worlds)
        return self.cleaned

    def begin(self, worlds: Worlds) -> None:
        """Put worlds back to their start."""
        fleet = self.fleet
        kernels_drive.begin(
            worlds, self._initial, self._simulation.clock.now, self._speeds, self._epochs,
            fleet._command, fleet._velocity, fleet._stalled, fleet.rows, fleet.nbody,
            *[fleet._lists()[index] for index in (0, 2, 3, 4)],
        )  # fmt: skip
        self._lidar.noise.reset(worlds)

    def _measure(self, first: int, last: int, part: int, worlds: Worlds) -> None:
        scanner = self._scanner
        fleet, own = self.fleet, scanner.arguments(part)
        own_scan = (
            *own[:3], self._fan, own[4], fleet.widest, *scanner._looks(), *own[5:],
            self._ranges, scanner.names,
        )  # fmt: skip
        found, turned, values = self._rooms[part]
        kernels_lidar.see(
            first, last, worlds, self._statics.faces, self._statics.discs, found, turned,
            *own[:3], self._fan, fleet.kinds, fleet.looks, fleet.rows, own[5], self._ranges,
            scanner.names, own_scan,
        )  # fmt: skip
        noise = self._lidar.noise
        kernels_lidar.report(
            first, last, worlds, self._ranges, self._law, noise._stddev[:, 0],
            noise._stream.keys, noise._stream.counters, values, values.view(np.uint64),
            self.cleaned,
        )  # fmt: skip

    def _timetable(self) -> tuple[Floats, Floats]:
        """Go on with clock and schedules by a control step; when drive and paths are due."""
        clock, drive, paths = self._simulation.clock, self._drive.entry.schedule, self._paths
        intervals = np.full(self._steps, math.nan)
        moments = np.full(self._steps, math.nan)
        for step in range(self._steps):
            if drive is not None and drive.is_due(clock.now_ns):
                intervals[step], self._last = clock.now - self._last, clock.now
                drive.done(clock.now_ns)
            schedules = [entry.schedule for entry in paths.entries if entry.schedule is not None]
            if schedules and schedules[0].is_due(clock.now_ns):
                moments[step] = clock.now
                for schedule in schedules:
                    schedule.done(clock.now_ns)
            clock.advance(1)
        return intervals, moments

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

    def poses(self, worlds: Worlds) -> tuple[Floats, Floats]:
        """Where the robots are [m], shape (n, 2), and their headings [rad], shape (n,)."""
        rows = self.fleet.rows[worlds * self.fleet.nbody + self.body]
        return rows[:, :2], rows[:, 2]
