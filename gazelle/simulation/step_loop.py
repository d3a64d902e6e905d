"""Step loop: physics steps, with updates and requests between them."""

from __future__ import annotations

import math
import sys
import time
import warnings
from collections.abc import Callable, Hashable, Sequence

import numpy as np

from gazelle.engines import DivergenceError, Engine
from gazelle.engines.limits import NANOSECONDS
from gazelle.errors import SimulationError, SimulationWarning
from gazelle.native.system import System
from gazelle.simulation.applied_wrenches import AppliedWrenches
from gazelle.simulation.clock import Schedule
from gazelle.simulation.divergence import FaultLog
from gazelle.simulation.entities import EntityManager
from gazelle.simulation.falling import FallWatch
from gazelle.simulation.robot import RobotHost
from gazelle.simulation.scheduled_systems import ScheduledSystem
from gazelle.simulation.step_plan import (
    Scheduled,
    StepPlan,
    set_due,
    steps_to_next,
    update_plugins,
    update_sensors,
    with_kernels,
)
from gazelle.simulation.systems_in_step import SystemsInStep

CLOSED = "the simulation is closed"

# Longest uninterrupted run of physics steps [s], while other threads make requests and while none
# do. Work between runs evicts the physics' data from the processor's caches and slows it down.
_PIECE, _LONG_PIECE = 0.003, 0.02

# A thread that made a request this recently is expected to make another [s].
_LATELY = 1.0


class StepLoop:
    """Steps a simulation from one thing that is due to the next.

    The physics is never stepped for longer than some milliseconds at once, or for one step, so
    that other threads get their answers quickly: within 3 ms after a recent request. Results do
    not depend on where it is cut.

    Args:
        simulation: The owner.
        engine: Steps the physics.
        applied_wrenches: Of the simulation.
        entities: Likewise.
        faults: Called with worlds that break down.

    Attributes:
        cut: Whether the last steps ended for the sake of others, with nothing due.
        spent: Wall time of all steps so far, with sensors and plugins [s].
        followers: Called after every step, before sensors measure.
        in_step: Systems that act within steps.
    """

    def __init__(
        self,
        simulation: RobotHost,
        engine: Engine,
        applied_wrenches: AppliedWrenches,
        entities: EntityManager,
        faults: FaultLog,
    ) -> None:
        self._simulation = simulation
        self._engine = engine
        self._applied_wrenches = applied_wrenches
        self._entities = entities
        self._faults = faults
        self._falls = FallWatch(engine)
        self._plan = StepPlan((), (), 1)
        self._planned: tuple[int, bool, int, int] | None = None
        self._systems: list[System] = []
        self.in_step = SystemsInStep()
        self._schedules: list[Schedule] = []
        self._most = 1
        self._requested = -math.inf  # wall time of the last request [s]
        self.cut = False
        self.spent = 0.0
        self.followers: list[Callable[[], None]] = []
        self._listeners: list[Callable[[], None]] = []

    def listen(self, listener: Callable[[], None]) -> Callable[[], None]:
        """Call a function after every step, when sensors have measured; returns what ends it."""
        self._listeners.append(listener)

        def end() -> None:
            if listener in self._listeners:
                self._listeners.remove(listener)

        return end

    def advance(self, count: int, stop: Callable[[], bool]) -> None:
        """Advance by steps, and run queued requests between two of them.

        Args:
            count: Number of steps.
            stop: Called between two steps; True ends the run.

        Raises:
            SimulationError: The simulation is closed, or another thread closes it.
            DivergenceError: The state of a world diverged, and ``on_fault`` is "raise".
        """
        lock = self._simulation.lock
        lock.acquire()
        try:
            self._run(count, stop)
        finally:
            self.cut = False
            if lock.is_owner():  # else the lock was yielded to a thread that waits for this one
                try:
                    self._simulation.events.rested.emit()
                finally:
                    lock.release()

    def _run(self, remaining: int, stop: Callable[[], bool]) -> None:
        lock = self._simulation.lock
        while True:
            if lock.closed:
                raise SimulationError(CLOSED)
            if remaining <= 0 or stop():
                return
            begin = time.perf_counter()
            remaining -= self._advance(remaining)
            self.spent += time.perf_counter() - begin
            if remaining > 0 and lock.waiting:
                self.cut = False
                self._shorten()
                lock.yield_lock()

    def _advance(self, most: int) -> int:
        """Run due updates, then step towards the next due time; returns the steps."""
        clock, applied = self._simulation.clock, self._applied_wrenches
        plugins = self._update_plugins()
        plan = self._plan
        if self._simulation.lock.closed:
            raise SimulationError(CLOSED)
        pushed = applied.any
        if pushed:
            applied.update(clock.now_ns)
        if self.followers or self._listeners:
            most = 1
        # Nothing is due within a single step: no plugin need be queried.
        steps = 1 if most == 1 else steps_to_next(plugins, plan.sensors, clock, most)
        if steps > 1:
            # Diverged worlds are reset within a second, and falling models are looked for.
            steps = min(steps, clock.steps_to((clock.now_ns // NANOSECONDS + 1) * NANOSECONDS))
            if self.in_step.kernels:
                steps = min(steps, self._steps_in_step())
        if pushed:
            steps = min(steps, applied.steps_until(clock) or steps)
        try:
            if steps < self._most:
                self._step(steps)
                self.cut = False
            else:
                steps = self._step_piece(steps)
        except DivergenceError as error:
            steps = self._give_up(error, steps)
        else:
            clock.advance(steps)
        self._finish_steps()
        return steps

    def _update_plugins(self) -> Sequence[Scheduled]:
        """Run due updates of Python plugins; returns those that the engine does not run."""
        simulation = self._simulation
        updated: set[int] = set()
        while True:
            plan = self._renew()
            if plan.settled is not None:
                self._systems, self._schedules = plan.settled
                set_due(self._systems, self._schedules)
                return ()
            self._systems, self._schedules, plugins = with_kernels(plan.early)
            fresh = plugins
            if updated:
                fresh = [each for each in plugins if updated.isdisjoint(each.members())]
            update_plugins(fresh, simulation.clock)
            if plan.late:
                late = self._not_in_step(updated)
                fresh = [each for each in late if updated.isdisjoint(each.members())]
                update_plugins(fresh, simulation.clock)
                plugins += late
            # An update may have activated a sensor, added or removed plugins, or changed the engine.
            if simulation.lock.closed or self._is_settled():
                return plugins
            for each in plugins:
                updated.update(each.members())

    def _not_in_step(self, updated: set[int]) -> list[ScheduledSystem]:
        """Return those that may act in steps, and that Python updates now."""
        return self.in_step.query(self._simulation.clock.now_ns, self._holds(), updated)

    def _holds(self) -> Hashable:
        """Return the cache key: engine revision, step size, applied wrenches."""
        return self._engine.revision, self._simulation.clock.step_ns, self._applied_wrenches.turned

    def _is_settled(self) -> bool:
        """Return whether the plan still holds."""
        return self._planned == self._now() and self.in_step.is_current(self._holds())

    def _steps_in_step(self) -> int:
        """Return the steps until Python has to update what runs in steps."""
        clock, soonest = self._simulation.clock, self.in_step.soonest_ns
        return clock.steps_to(int(soonest)) if math.isfinite(soonest) else sys.maxsize

    def _finish_steps(self) -> None:
        """Finish steps: move followers, measure, call listeners, check for falling models."""
        now_ns = self._simulation.clock.now_ns
        for follower in tuple(self.followers):
            follower()
        if self._plan.sensors:
            update_sensors(self._plan.sensors, now_ns)
        for listener in tuple(self._listeners):
            listener()
        self._falls.check(now_ns)

    def _renew(self) -> StepPlan:
        """Return the step plan, renewed if it is outdated."""
        now = self._now()
        if self._planned != now:
            self.release()
            entities = self._entities
            self._plan = StepPlan(
                entities.plugins,
                entities.sensors,
                self._simulation.nworld,
                # Kinematic followers move before sensors measure, so Python has to run in between.
                followed=bool(self.followers),
            )
            self.in_step.plan(self._plan.late)
            # Grouping may change the engine.
            self._planned = *now[:3], self._engine.revision
        return self._plan

    def _now(self) -> tuple[int, bool, int, int]:
        """Return the key of a plan: it holds while this is the same."""
        count, changes = len(self._entities.plugins), self._simulation.lock.changes
        return changes, bool(self.followers), count, self._engine.revision

    def release(self) -> None:
        """Update everything individually until a new plan is made."""
        self._plan.release()
        self._planned = None

    def _step(self, count: int) -> None:
        """Advance by steps, and update systems whenever they are due."""
        systems: Sequence[System] = self._systems
        if self._plan.groups or self.in_step.kernels:
            measured = (each.kernel for each in self._plan.groups)
            systems = [*self._systems, *(each for each in measured if each is not None)]
            systems += self.in_step.kernels
        try:
            self._engine.step(count, systems, self._simulation.clock.now_ns)
        finally:
            self._follow()

    def _follow(self) -> None:
        """Take over the due times of systems that ran in steps."""
        if self._plan.late:
            self.in_step.sync()
        for schedule, system in zip(self._schedules, self._systems, strict=True):
            if system.due != schedule.due_ns:
                schedule.follow(system.due)
        for group in self._plan.groups:
            group.follow()

    def _step_piece(self, count: int) -> int:
        """Make as many steps at once as are not too long; returns their number."""
        steps, begin, worked = self._most, time.perf_counter(), time.process_time()
        self._step(steps)
        # Shorter runs if other programs use the processor, so that requests wait less.
        took = min(time.perf_counter() - begin, time.process_time() - worked)
        longest = _PIECE if begin - self._requested < _LATELY else _LONG_PIECE
        # One run may be slow or fast by chance: change the length by a factor of two at most.
        if took * 2.0 < longest:
            self._most *= 2
        elif took > longest:
            self._most = max(1, self._most // 2)
        self.cut = steps < count
        return steps

    def _shorten(self) -> None:
        """Shorten pieces for a while because a request is waiting."""
        now = time.perf_counter()
        if now - self._requested >= _LATELY:
            self._most = max(1, int(self._most * _PIECE / _LONG_PIECE))
        self._requested = now

    def _give_up(self, error: DivergenceError, count: int) -> int:
        """Reset diverged worlds, as ``on_fault`` says, once the other worlds are at the same step.

        That is when Python comes next, within a second, so that it does not depend on where steps are cut.

        Args:
            error: Error of the first of the steps.
            count: Total number of steps.

        Returns:
            How many steps were made.
        """
        clock, worlds, before = self._simulation.clock, error.worlds, error.before
        clock.advance(error.made - error.steps)
        text = self._faults.note(self._simulation, error, clock.now_ns)
        clock.advance(error.steps)
        left = count - error.made
        while left > 0:
            try:
                self._step(left)
            except DivergenceError as later:
                made, new = later.made, ~np.isin(later.worlds, worlds)
                if new.any():
                    found = later.worlds[new], later.before[new]
                    more = DivergenceError(later.message, *found, later.steps, made)
                    text += f"; {self._faults.note(self._simulation, more, clock.now_ns)}"
                    worlds, before = np.append(worlds, found[0]), np.vstack((before, found[1]))
            else:
                made = left
            clock.advance(made)
            left -= made
        self._entities.reset(worlds)
        if self._faults.policy == "raise":
            raise DivergenceError(text, worlds, before, error.steps, error.made) from error
        warnings.warn(SimulationWarning(text), stacklevel=6)
        return count
