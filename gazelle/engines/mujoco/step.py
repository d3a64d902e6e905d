"""Steps of MuJoCo worlds, with systems that act in them and between them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from gazelle.array_types import Worlds
from gazelle.engines.engine import DivergenceError
from gazelle.engines.mujoco.divergence import divergence_report
from gazelle.engines.mujoco.step_forces import ForcedSteps
from gazelle.engines.mujoco.worlds import RunningWorlds
from gazelle.native.joint_system import JointSystem
from gazelle.native.loop import SystemLoop
from gazelle.native.system import System

_NANOSECONDS = 1_000_000_000


class WorldSteps:
    """Steps from one time at which a system is due to the next.

    MuJoCo calls systems of joints at the beginning of every step. All others are updated between
    two calls of MuJoCo, as threads of those work on copies of the state.

    Args:
        run: What runs.
        stepper: Steps it.
        reset: Puts worlds back to their initial state.
    """

    def __init__(
        self, run: RunningWorlds, stepper: ForcedSteps, reset: Callable[[Worlds], None]
    ) -> None:
        self._run, self._stepper, self._reset = run, stepper, reset
        self._kept: tuple[Sequence[System], list[JointSystem], SystemLoop | None] = [], [], None
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
        self._run.now()
        self._made = 0
        if not systems:
            self._advance(count)
            return
        if self._kept[0] != systems:
            self._kept = systems, *self._sorted(systems)
        _, joints, loop = self._kept
        if joints:
            with self._acting(joints, now_ns):
                self._run_around(loop, count, now_ns)
        else:
            self._run_around(loop, count, now_ns)

    def _run_around(self, loop: SystemLoop | None, count: int, now_ns: int) -> None:
        """Make steps, and update systems between them."""
        if loop is None:
            self._advance(count)
            return
        step = round(self._run.time_step * _NANOSECONDS)
        until = now_ns + count * step
        for each in loop.systems:
            if each.due <= until:
                break
        else:  # nothing is due, as in most single steps
            self._advance(count)
            return
        loop.step, loop.time = step, now_ns
        loop.run_around(until, self._advance)

    def _sorted(self, systems: Sequence[System]) -> tuple[list[JointSystem], SystemLoop | None]:
        """Systems that act within MuJoCo's steps, and those that act between them."""
        joints = [each for each in systems if isinstance(each, JointSystem)]
        others = [each for each in systems if not isinstance(each, JointSystem)]
        return joints, SystemLoop(others, self._run.nworld, 1) if others else None

    @contextmanager
    def _acting(self, joints: Sequence[JointSystem], now_ns: int) -> Iterator[None]:
        """Let systems of joints act while it lasts."""
        hooks, stepper = self._run.hooks, self._stepper
        hooks.begin(joints, now_ns, round(self._run.time_step * _NANOSECONDS))
        stepper.holds_back = True
        try:
            yield
        except DivergenceError as error:
            hooks.kept[error.worlds] = 0.0
            raise
        finally:
            stepper.holds_back = False
            hooks.end(self._run.state.qfrc_applied)

    def _advance(self, count: int) -> None:
        """Make steps at whose beginning and end alone something may be changed."""
        run = self._run
        run.stale = True
        if run.dropped:
            self.find_dropped()
        np.copyto(run.before, run.batch.state)
        failed = self._recover(count) if run.overlaps.any else self._stepper.advance(count)
        run.placed = False
        run.moved.fill(0.0)
        self._made += count
        # MuJoCo itself resets a simulation whose state became bad, and counts a warning.
        faults = run.state.faults
        if len(failed) or np.count_nonzero(faults):
            bad = np.asarray(faults.any(axis=1))
            bad[sorted(failed)] = True
            self._give_up(np.flatnonzero(bad), count)

    def find_dropped(self) -> None:
        """Let out slowly, too, what free bodies were put into since the last step."""
        if self._run.dropped:
            self._run.overlaps.drop(self._run.batch, self._run.dropped)
            self._run.dropped = {}

    def _recover(self, count: int) -> set[int]:
        """Make the steps with what overlaps rising; returns those in which MuJoCo gave up."""
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
        """Reset worlds that broke down, and say so.

        Raises:
            DivergenceError: Always.
        """
        before = self._run.before[worlds].copy()
        who = divergence_report(self._run.layout, self._run.state, self._run.batch.state, before[0])
        self._run.batch.warning[worlds] = 0
        self._reset(worlds)
        raise DivergenceError(
            f"the state of {len(worlds)} of {self._run.nworld} worlds became infinite "
            f"(first: world {worlds[0]}{who and ', where ' + who})",
            worlds,
            before,
            count,
            self._made,
        )
