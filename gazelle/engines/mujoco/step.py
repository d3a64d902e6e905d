"""Steps of MuJoCo worlds, with systems that act in them and between them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.engines.engine import DivergenceError
from gazelle.engines.limits import NANOSECONDS
from gazelle.engines.mujoco.divergence import divergence_report
from gazelle.engines.mujoco.step_forces import ForcedSteps
from gazelle.engines.mujoco.worlds import RunningWorlds
from gazelle.native.acting import AHEAD, BETWEEN, IN_STEP, OF_JOINTS
from gazelle.native.joint_system import JointSystem
from gazelle.native.loop import SystemLoop
from gazelle.native.system import System
from gazelle.native.worker_pool import WorkerPool


class WorldSteps:
    """Steps from one time at which a system acts between two of them to the next.

    MuJoCo updates systems in the middle of its steps that need no more than it can show there. All
    others are updated between two calls of MuJoCo, as threads of those work on copies of the state.

    Args:
        run: Running worlds.
        stepper: Steps it.
        reset: Puts worlds back to their initial state.
        in_step: Returns whether the integrator looks at forces once a step.
        pool: Threads that share what is updated between two steps.
    """

    def __init__(
        self,
        run: RunningWorlds,
        stepper: ForcedSteps,
        reset: Callable[[Worlds], None],
        in_step: Callable[[], bool],
        pool: WorkerPool,
    ) -> None:
        self._pool = pool
        self._run, self._stepper, self._reset, self._in_step = run, stepper, reset, in_step
        self._kept: tuple[Sequence[System], int, bool] = (), 0, False
        self._loop, self._within = SystemLoop((), 1, 1), False
        self._made = 0  # steps of this call

    def make(self, count: int, systems: Sequence[System], now_ns: int) -> None:
        """Advance every world.

        Args:
            count: Physics steps.
            systems: In the order in which they act.
            now_ns: Simulated time [ns].

        Raises:
            DivergenceError: The state of some worlds became infinite.
        """
        run = self._run
        run.up_to_date()
        self._made = 0
        if not systems:
            self._advance(count)
            return
        held = systems, run.revision, run.overlaps.any
        if self._kept != held:
            self._kept = held
            self._sort(systems)
        loop = self._loop
        loop.step, loop.time = round(run.time_step * NANOSECONDS), now_ns
        until = now_ns + count * loop.step
        if not self._within:
            loop.run_around(until, self._advance)
            return
        run.hooks.begin(loop, now_ns)
        self._stepper.holds_back = True
        try:
            loop.run_around(until, self._advance)
        except DivergenceError as error:
            run.hooks.kept[error.worlds] = 0.0
            raise
        finally:
            self._stepper.holds_back = False
            run.hooks.end(run.state.qfrc_applied)

    def _sort(self, systems: Sequence[System]) -> None:
        """Find out which systems MuJoCo's steps can update; those of joints come last."""
        found, free = [], True
        for system in reversed(systems):
            acts = self._acts(system)
            if acts in (IN_STEP, AHEAD) and not free:
                acts = BETWEEN  # one that may depend on it is updated after it, between two steps
            free = free and (acts != BETWEEN or system.late or system.uses is not None)
            found.append((acts, system))
        found.reverse()
        found.sort(key=lambda each: each[0] == OF_JOINTS)
        made = [system for _, system in found], [acts for acts, _ in found]
        self._loop = SystemLoop(made[0], self._run.nworld, 1, self._pool, acts=made[1])
        self._within = any(made[1])

    def _acts(self, system: System) -> int:
        """Return when a system is updated, of ``gazelle.native.acting``."""
        run, used = self._run, system.uses
        if not (run.recipe.hooks and self._in_step()):
            return BETWEEN
        if isinstance(system, JointSystem):
            return OF_JOINTS
        if system.late or used is None:
            return BETWEEN
        targets, mocap = run.motor_targets, (run.state.mocap_pos, run.state.mocap_quat)
        if all(_is_part(each, (targets,)) for each in used):
            return IN_STEP
        if run.sleepy or run.overlaps.any or not all(_is_part(each, mocap) for each in used):
            return BETWEEN
        return AHEAD

    def _advance(self, count: int) -> None:
        """Advance by steps between which nothing has to change."""
        run = self._run
        run.stale = True
        if run.dropped:
            self.find_dropped()
        np.copyto(run.before, run.batch.state)
        failed = self._recover(count) if run.overlaps.any else self._stepper.advance(count)
        run.placed = False
        run.moved.fill(0.0)
        self._made += count
        # MuJoCo itself resets a simulation with a bad state, and counts a warning.
        faults = run.state.faults
        if len(failed) or np.count_nonzero(faults):
            bad = np.asarray(faults.any(axis=1))
            bad[sorted(failed)] = True
            self._give_up(np.flatnonzero(bad), count)

    def find_dropped(self) -> None:
        """Start the recovery of free bodies that were placed into others since the last step."""
        if self._run.dropped:
            self._run.overlaps.drop(self._run.batch, self._run.dropped)
            self._run.dropped = {}

    def _recover(self, count: int) -> set[int]:
        """Advance with penetration recovery; returns the worlds in which MuJoCo diverged."""
        if self._run.placed or self._run.moved[0]:
            self._run.overlaps.clear(self._run.batch)
        failed: set[int] = set()
        while count > 0:
            piece = count
            if self._run.overlaps.any:
                piece = min(count, self._run.overlaps.rise(self._run.batch, self._run.time_step))
            failed |= self._run.overlaps.advance_bounded(
                self._run.state, piece, self._stepper.advance
            )
            count -= piece
        return failed

    def _give_up(self, worlds: Worlds, count: int) -> None:
        """Reset diverged worlds, and report them.

        Raises:
            DivergenceError: Always.
        """
        before = self._run.before[worlds].copy()
        cause = divergence_report(
            self._run.layout, self._run.state, self._run.batch.state, before[0]
        )
        self._run.batch.warning[worlds] = 0
        self._reset(worlds)
        raise DivergenceError(
            f"the state of {len(worlds)} of {self._run.nworld} worlds became infinite "
            f"(first: world {worlds[0]}{cause and ', where ' + cause})",
            worlds,
            before,
            count,
            self._made,
        )


def _is_part(array: Floats, fields: Sequence[Floats]) -> bool:
    """Return whether an array of all worlds is part of one field of their states."""
    low, high = np.lib.array_utils.byte_bounds(array[:1])
    bounds = (np.lib.array_utils.byte_bounds(each[:1]) for each in fields)
    return any(first <= low and high <= last for first, last in bounds)
