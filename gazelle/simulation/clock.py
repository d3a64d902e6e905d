"""Simulated time in whole nanoseconds, and things that happen at a rate of it."""

from __future__ import annotations

import math

from gazelle.argument_checks import checked
from gazelle.engines.limits import NANOSECONDS, physics_step
from gazelle.errors import SimulationError


class Clock:
    """Counts physics steps.

    Args:
        step: Physics step [s]; rounded to whole nanoseconds.

    Raises:
        EngineError: A clock cannot count such steps.
    """

    def __init__(self, step: float) -> None:
        self.set_step(step)
        self.now_ns = 0

    @property
    def now(self) -> float:
        """Simulated time [s]."""
        return self.now_ns / NANOSECONDS

    def set_step(self, step: float) -> None:
        """Set the physics step [s]."""
        self.step_ns = round(physics_step(step) * NANOSECONDS)

    def advance(self, steps: int) -> None:
        """Advance by physics steps."""
        try:
            self.now_ns += steps * self.step_ns
        except OverflowError:  # of numpy's ints
            raise _beyond(steps) from None

    @checked(SimulationError, after=True)
    def steps_in(self, seconds: float) -> int:
        """Return the number of physics steps nearest to a time."""
        return round(seconds * NANOSECONDS / self.step_ns)

    def steps_to(self, due_ns: int) -> int:
        """Return the physics steps until a time, at least 1."""
        try:
            return max(1, -((self.now_ns - due_ns) // self.step_ns))
        except OverflowError:  # of numpy's ints
            raise _beyond(due_ns) from None


class Stopwatch:
    """Stopwatch that counts in integer nanoseconds.

    The difference of two times in seconds is wrong by the last digit of those times, the more the
    longer a simulation runs; that of two counts is not.

    Args:
        clock: Clock of the schedule; it is started at once.

    Attributes:
        start_ns: Time of its start [ns].
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self.start_ns = clock.now_ns

    @property
    def elapsed(self) -> float:
        """Time since the start [s]."""
        return (self._clock.now_ns - self.start_ns) / NANOSECONDS

    def restart(self) -> None:
        """Start again."""
        self.start_ns = self._clock.now_ns

    def lap(self) -> float:
        """Return the time since the start [s], and start again."""
        elapsed = self.elapsed
        self.restart()
        return elapsed


class Schedule:
    """When something is due: at multiples of its period, on the first step not before.

    Multiples are counted from time zero, so a 30 Hz update on 10 ms steps keeps 30 Hz on
    the average and never drifts.

    Args:
        rate: [Hz]; 0 means every physics step. A period is a nanosecond at least, and some thirty
            years at most.

    Attributes:
        due_ns: The next time at which it is due [ns]; 0 for "every step".
    """

    def __init__(self, rate: float) -> None:
        self.rate = rate
        self.due_ns = 0
        self._count = 0

    @property
    def rate(self) -> float:
        """Rate at which it is due [Hz]; 0 for every step."""
        return self._rate

    @rate.setter
    def rate(self, value: float) -> None:
        if isinstance(value, float) and math.isnan(value):
            raise SimulationError("a rate must be a number, not NaN")
        self._rate = min(max(value, 1.0 / NANOSECONDS), NANOSECONDS) if value > 0.0 else 0.0

    @property
    def count(self) -> int:
        """The next time it is due, in periods."""
        return self._count

    @count.setter
    def count(self, value: int) -> None:
        try:
            due_ns = 0 if self._rate <= 0.0 else round(value * NANOSECONDS / self._rate)
        except OverflowError:
            raise _beyond(value) from None
        self._count, self.due_ns = value, due_ns

    def copy(self) -> Schedule:
        """Return a schedule that is due at the same times."""
        made = Schedule(self.rate)
        made._count, made.due_ns = self._count, self.due_ns
        return made

    def follow(self, due_ns: int) -> None:
        """Set the time [ns] at which it is due next."""
        if self._rate > 0.0:
            try:
                self._count, self.due_ns = round(due_ns * self._rate / NANOSECONDS), due_ns
            except OverflowError:
                raise _beyond(due_ns) from None

    def is_due(self, now_ns: int) -> bool:
        """Return whether it is due."""
        return now_ns >= self.due_ns

    def done(self, now_ns: int) -> None:
        """Set the next due time to the first multiple after now."""
        if self.rate > 0.0:
            try:
                self.count = int(now_ns * self.rate // NANOSECONDS)
            except OverflowError:
                raise _beyond(now_ns) from None
            while self.due_ns <= now_ns:
                self.count += 1

    def restart(self) -> None:
        """Start over at time zero."""
        self.count = 0


def _beyond(count: int) -> SimulationError:
    return SimulationError(f"a clock cannot count to {count!r:.60}")
