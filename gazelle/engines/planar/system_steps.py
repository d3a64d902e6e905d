"""Steps of a fleet, with systems that are updated before, in and after them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from gazelle.engines.limits import NANOSECONDS
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.rolling import Joints, Rolling, Turning
from gazelle.errors import EngineError
from gazelle.native.loop import SystemLoop
from gazelle.native.system import System

_WORTH = 4  # times what is worth a thread: from so much work on other threads are woken for it


class SystemSteps:
    """Steps a fleet and joints; its native loop is kept between calls.

    Args:
        fleet: Moves bodies.
        joints: Gives joints and rolling bases as kernels see them.
        axes: Number of joint axes.
    """

    def __init__(self, fleet: Fleet, joints: Callable[[], Joints], axes: int) -> None:
        self._fleet, self._joints, self._axes = fleet, joints, axes
        self._before: tuple[System, ...] = ()
        self._after: tuple[System, ...] = ()
        self._kept: tuple[Sequence[System], SystemLoop, int] | None = None

    def forget(self) -> None:
        """Discard the plan of a step after joints or the step changed."""
        self._kept = None

    def surround(self, before: Sequence[System], after: Sequence[System]) -> None:
        """Set systems to update first and last in every step, besides those given."""
        around = tuple(before), tuple(after)
        if around != (self._before, self._after):
            (self._before, self._after), self._kept = around, None

    def make(self, systems: Sequence[System], count: int, now_ns: int) -> None:
        """Advance by steps.

        Args:
            systems: Updated whenever they are due, in this order.
            count: Number of steps.
            now_ns: Time [ns].

        Raises:
            EngineError: No clock counts such a time.
        """
        if not count:
            return
        if self._kept is None or self._kept[0] != systems:
            self._kept = systems, *self._assemble(systems)
        _, loop, threads = self._kept
        loop.step = round(self._fleet.time_step * NANOSECONDS)
        try:
            loop.time = now_ns
            loop.run(now_ns + count * loop.step, threads)
        except OverflowError:  # free of cost, unlike a look at the time before each step
            raise EngineError(f"the clock cannot count {count} steps from {now_ns} ns") from None
        self._fleet.changes += 1

    def _assemble(self, systems: Sequence[System]) -> tuple[SystemLoop, int]:
        """Return the loop that makes steps with these systems, and its number of threads."""
        fleet, joints = self._fleet, self._joints()
        last = [Turning(fleet.bodies, joints)] if self._axes else []
        early = [each for each in systems if not each.late]
        late = [each for each in systems if each.late]
        first = [*early, *self._before, Rolling(fleet.bodies, joints)]
        made = [*first, *fleet.systems(), *last, *self._after, *late]
        rows = [(fleet.nworld * each.rows, _WORTH * each.least) for each in systems]
        heavy = any(count >= least > _WORTH for count, least in rows)
        return SystemLoop(made, fleet.nworld, 1, fleet.pool), 0 if heavy else fleet.threads
