"""Robots without recent commands are stopped."""

from __future__ import annotations

import numpy as np

from gazelle.stage import StageFleet


class Watchdog:
    """Stops a robot when its last command is too old; robots never commanded are left alone.

    Unlike in stage_ros each robot has its own, so that robots with a controller and robots
    driven over ROS can share a world.

    Args:
        simulation: Runs.
        timeout: In simulated time [s]; 0 or less for never.
        world: World of a batch.
    """

    def __init__(self, simulation: StageFleet, timeout: float, world: int) -> None:
        self._simulation, self._world = simulation, world
        self._timeout_ns = round(timeout * 1e9) if np.isfinite(timeout) else 0
        self._due = np.full(len(simulation.robots), np.iinfo(np.int64).max, np.int64)

    def note_command(self, robot: int) -> None:
        """Record a command of a robot."""
        if self._timeout_ns > 0:
            self._due[robot] = self._simulation.clock.now_ns + self._timeout_ns

    def check(self) -> None:
        """Stop those whose time is over."""
        late = self._simulation.clock.now_ns >= self._due
        if late.any():
            self._simulation.commands[self._world, late] = 0.0
            self._due[late] = np.iinfo(np.int64).max

    def forget(self) -> None:
        """Discard the times after a reset."""
        self._due[:] = np.iinfo(np.int64).max
