"""Integration of Stage's robots into a simulation's steps."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.native.system import System
from gazelle.simulation.plugin import WorldPlugin
from gazelle.simulation.plugin_system import InStepWork, PluginSystem
from gazelle.stage.fleet import StageFleet
from gazelle.states import Restorable, restore_all, states_of


class Steps(Protocol):
    """Protocol of what makes steps.

    Attributes:
        followers: Called after every step, before sensors measure.
    """

    followers: list[Callable[[], None]]


class StageRunner(WorldPlugin):
    """Robots of Stage files, as a plugin that is reset, saved and restored.

    Args:
        fleet: The robots.
        steps: Makes steps.
    """

    update_rate = 0.0

    def __init__(self, fleet: StageFleet, steps: Steps) -> None:
        self._fleet, self._steps = fleet, steps
        self.system = StageSystem
        self._following = False
        self._bound: tuple[int, int] | None = None

    def control(self) -> None:
        """Update controllers in Python."""
        for controller in self._fleet.controllers:
            controller.update()

    def bind(self) -> tuple[System, ...] | None:
        """Return the kernels of all controllers, once the engine has those of motion; None for Python."""
        fleet, motion = self._fleet, self._fleet.motion
        now = fleet.engine.revision, len(motion.last)
        if now != self._bound:
            self._bound = now
            fleet.engine.surround(motion.first, motion.last)
        self._follow(enabled=bool(fleet.devices))
        systems = self._systems()
        return None if systems is None else tuple(systems)

    def _systems(self) -> list[System] | None:
        """Return what the controllers do, in native code; None if that is not all."""
        found: list[System] = []
        for controller in self._fleet.controllers:
            its = controller.systems()
            if its is None:
                return None
            found += its
        return found

    def _follow(self, *, enabled: bool) -> None:
        if enabled == self._following:
            return
        self._following = enabled
        if enabled:
            self._steps.followers.append(self._move_devices)
        else:
            self._steps.followers.remove(self._move_devices)

    def _move_devices(self) -> None:
        self._fleet.devices.update(self._fleet.time_step)

    # -- as a plugin -------------------------------------------------------------------

    def reseed(self, seed: int, worlds: Worlds | None) -> None:
        """Set the seed of the random numbers; a reset follows."""
        if worlds is None:
            self._fleet.seed = seed
        self._fleet.motion.odometry.stream.reseed(seed, worlds)
        self._fleet.rangers.reseed(seed, worlds)

    def reset(self, worlds: Worlds | None) -> None:
        """Start over; the engine has put bodies back."""
        fleet = self._fleet
        fleet.refresh()
        fleet.start_over(worlds)
        if worlds is None:
            fleet.rangers.rewind()
        for controller in fleet.controllers:
            controller.reset(worlds)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return all mutable state except bodies."""
        return states_of(self._parts())

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        restore_all(self._parts(), state)

    def _parts(self) -> dict[str, Restorable]:
        fleet = self._fleet
        parts: dict[str, Restorable] = {
            f"controller{i}": p for i, p in enumerate(fleet.controllers)
        }
        return {
            "motion": fleet.motion,
            "rangers": fleet.rangers,
            "devices": fleet.devices,
            **parts,
        }


class StageSystem(PluginSystem[StageRunner]):
    """The controllers of Stage's robots, in native code unless a user's own act in Python."""

    single = True

    def update(self, time: float) -> None:  # noqa: ARG002  controllers look at the clock
        """Update the controllers."""
        self.plugins[0].control()

    def in_step(self) -> InStepWork | None:
        """Return the controllers' kernels, if those are all."""
        kernels = self.plugins[0].bind()
        return None if kernels is None else InStepWork(kernels, math.inf)
