"""What lets the robots of Stage files act in a simulation's steps."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.native.system import System
from gazelle.simulation.plugin import WorldPlugin
from gazelle.simulation.stage.fleet import StageFleet
from gazelle.states import Restorable, restore_all, states_of


class Steps(Protocol):
    """What makes steps.

    Attributes:
        followers: Called after every step, before sensors measure.
    """

    followers: list[Callable[[], None]]


class StageRunner(WorldPlugin):
    """Has native code do what Stage's robots do in a step; in Python what is not all native.

    Args:
        fleet: The robots.
        steps: Makes steps.
        is_native: Whether systems are updated, or what they would do is to be done in Python by
            calls of the engine, as somebody records these.
    """

    update_rate = 0.0

    def __init__(self, fleet: StageFleet, steps: Steps, is_native: Callable[[], bool]) -> None:
        self._fleet, self._steps, self._is_native = fleet, steps, is_native
        self._following = False
        self._bound: tuple[int, bool, int] | None = None
        self._told = np.zeros(0)

    @property
    def active(self) -> bool:
        """Whether something has to be done in Python before the next step."""
        acting = self._bind()
        return acting or not self._is_native()

    def on_update(self, time: float) -> None:  # noqa: ARG002  controllers look at the clock
        """Ask the controllers; write down what drives are told if somebody records."""
        for controller in self._fleet.controllers:
            controller.update()
        if not self._is_native():
            wanted = self._fleet.fleet.command
            if not np.array_equal(wanted, self._told):
                self._told = wanted.copy()
                self._fleet.engine.command(self._told)

    def _bind(self) -> bool:
        """Have the engine update what is native now; whether controllers act in Python."""
        fleet, is_native = self._fleet, self._is_native()
        motion = fleet.motion
        now = fleet.engine.revision, is_native, len(motion.last)
        if now == self._bound and not fleet.controllers:
            return False
        self._bound = now
        native = self._systems() if is_native else None
        fleet.engine.surround([*(native or ()), *motion.first], motion.last)
        self._follow(wanted=bool(fleet.devices))
        return native is None and bool(fleet.controllers)

    def _systems(self) -> list[System] | None:
        """What the controllers do, in native code; None if that is not all."""
        found: list[System] = []
        for controller in self._fleet.controllers:
            its = controller.systems()
            if its is None:
                return None
            found += its
        return found

    def _follow(self, *, wanted: bool) -> None:
        if wanted == self._following:
            return
        self._following = wanted
        if wanted:
            self._steps.followers.append(self._move_devices)
        else:
            self._steps.followers.remove(self._move_devices)

    def _move_devices(self) -> None:
        self._fleet.devices.update(self._fleet.time_step)

    # -- as a plugin -------------------------------------------------------------------

    def reseed(self, seed: int, worlds: Worlds | None) -> None:
        """Use the random numbers of another seed; a reset follows."""
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
        """Everything that changes but bodies."""
        return states_of(self._parts())

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
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
