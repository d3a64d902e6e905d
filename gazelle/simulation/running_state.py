"""A simulation as its parts know it: the engine, the clock, and the lock on the state."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from gazelle.description import World
from gazelle.engines import Engine
from gazelle.simulation.applied_wrenches import AppliedWrenches
from gazelle.simulation.clock import Clock
from gazelle.simulation.state_lock import StateLock
from gazelle.simulation.systems_in_step import SystemsInStep


class RunningState(Protocol):
    """A simulation as its handles, parameters and records see it.

    Attributes:
        lock: On all of the state.
        clock: Simulated time.
        seed: Decides all random numbers.
        engine_name: The requested one.
        controls_in_step: Whether controllers act within the engine's steps, where it can.
    """

    lock: StateLock
    clock: Clock
    seed: int
    engine_name: str
    controls_in_step: bool

    @property
    def nworld(self) -> int:
        """Number of worlds."""

    @property
    def world(self) -> World:
        """The world that runs."""

    @property
    def engine(self) -> Engine:
        """Engine that moves the world."""

    @property
    def applied_wrenches(self) -> AppliedWrenches:
        """Forces and torques that act for a time."""


class StepMaker(Protocol):
    """Protocol of what makes the steps of a simulation; see ``StepLoop``.

    Attributes:
        followers: Called after every step, before sensors measure.
        in_step: The plugins that run within steps.
    """

    followers: list[Callable[[], None]]
    in_step: SystemsInStep

    def release(self) -> None:
        """Update everything individually until a new plan is made."""
