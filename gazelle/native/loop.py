"""Update systems in order, step by step, on all threads, without Python between."""

# mypy: disallow-untyped-decorators=False

from collections.abc import Callable, Sequence
from typing import Any, Protocol
from weakref import WeakValueDictionary

import cython
import numpy as np
from cython.cimports.gazelle.native.acting import (
    ACTS,
    ADDRESS,
    AHEAD,
    BETWEEN,
    DIVISIBLE,
    LATE,
    LEAST,
    MERGEABLE,
    ROWS,
    STEADY,
    WIDTH,
)
from cython.cimports.gazelle.native.blocks import next_block
from cython.cimports.gazelle.native.due_times import next_due
from cython.cimports.gazelle.native.system import System

from gazelle.native.worker_pool import BLOCKS_A_THREAD

if not cython.compiled:
    APART = 16  # in a compiled module, what loop.pxd says


# Systems by their addresses, for Python that runs the sources of compiled modules.
KNOWN: WeakValueDictionary[int, Any] = WeakValueDictionary()


class Pool(Protocol):
    """Threads that work at once."""

    size: int

    def call(self, work: Callable[[int], Any], parts: int) -> list[Any]:
        """Call ``work(part)`` for each part, all at the same time."""

    def update(self, system: System, nworld: int, time: int) -> None:
        """Update all rows of a system."""


@cython.cclass
class SystemLoop:
    """Systems that are updated one after another in every step in which they are due.

    Worlds know nothing of each other. So where there are enough of them, a thread takes a block
    of worlds through all steps by itself, and then the next block. Where there are few, each
    system is shared out among the threads, which wait for each other after every update.

    Args:
        systems: In the order in which they are updated. Where worlds are divided among threads, the
            mergeable ones make all steps at once until a system with a rate is due; so they need
            nothing of each other.
        nworld: Number of worlds.
        step: Simulated time of a step [ns].
        pool: Threads to share the work among; None: the calling one works alone.
        time: Start time [ns].
        acts: Phase in which an engine with steps of its own updates each system, of
            ``gazelle.native.acting``; all between two steps if None.

    Attributes:
        time: Of the next step [ns].

    Raises:
        ValueError: There is no world, or a step takes no time.
    """

    def __init__(
        self,
        systems: Sequence[System],
        nworld: cython.Py_ssize_t,
        step: cython.longlong,
        pool: Pool | None = None,
        time: cython.longlong = 0,
        acts: Sequence[int] | None = None,
    ) -> None:
        if nworld < 1 or step < 1:
            raise ValueError(f"there are {nworld} worlds and steps of {step} ns")
        self.systems = list(systems)
        if not all(isinstance(each, System) for each in self.systems):
            raise TypeError("a SystemLoop takes System objects")
        self.nworld, self.step, self.time, self._pool = nworld, step, time, pool
        size = 1 if pool is None or not cython.compiled else pool.size
        acts = acts or [BETWEEN] * len(self.systems)
        table = [
            (id(e), e.rows, e.divisible, e.late, e.least, e.steady, when, e.mergeable)
            for e, when in zip(self.systems, acts, strict=True)
        ]
        self._table = np.array(table, np.int64).reshape(-1, WIDTH)
        self._rates = np.array([each.rate for each in self.systems], np.float64)
        self._due = np.zeros((size + 1, len(self.systems)), np.int64)  # the last: at the beginning
        self._shared = np.zeros(APART + 2, np.int64)
        self._end = np.zeros(1, np.int64)

    def run(self, until: cython.longlong, threads: cython.Py_ssize_t = 0) -> None:
        """Advance by steps that start before a time.

        Args:
            until: Simulated time [ns].
            threads: At most so many; 0: as many as the pool has.
        """
        most: cython.Py_ssize_t = self._due.shape[0] - 1
        threads = most if threads < 1 else min(threads, most)
        blocks: cython.Py_ssize_t = min(self.nworld, threads * BLOCKS_A_THREAD)
        alone: cython.bint = threads == 1 or self.nworld >= 2 * threads
        index: cython.Py_ssize_t
        system: System
        for index in range(self._due.shape[1]):
            system = self.systems[index]
            self._due[most, index] = system.due
        self._shared[0] = self._shared[APART] = self._shared[APART + 1] = 0

        def work(part: int) -> None:
            if alone:
                self.play_worlds(part, 1 if threads == 1 else blocks, until)
            else:
                self.play_together(part, threads, until)

        if threads == 1 or self._pool is None:
            work(0)
        else:
            self._pool.call(work, threads)
        self._pass(most, until)
        for index in range(self._due.shape[1]):
            system = self.systems[index]
            system.due = self._due[most, index]

    def run_around(self, until: cython.longlong, advance: Callable[[int], object]) -> None:
        """Update systems on this thread between steps that something else makes.

        Args:
            until: Simulated time [ns].
            advance: Makes a given number of steps, at whose beginning or end systems are due, and not between.
        """
        row: cython.Py_ssize_t = self._due.shape[0] - 1
        index: cython.Py_ssize_t
        steps: cython.longlong
        system: System
        for index in range(self._due.shape[1]):
            system = self.systems[index]
            self._due[row, index] = system.due
            if self._table[index, ACTS] != BETWEEN and system.rate > 0.0:
                self._due[row, index] = max(system.due, self.time)  # what is late is due at once
        self._end[0] = self.time
        try:
            while self.time < until:
                self._update_due(row, 0)
                with cython.nogil:
                    steps = self._steps_to_due(row, until)
                    self._end[0] = self.time + steps * self.step
                advance(steps)
                self.time = self._end[0]
                with cython.nogil:
                    self._pass_within(row)
                self._update_due(row, 1)
        finally:
            self._pass_within(row)
            for index in range(self._due.shape[1]):
                system = self.systems[index]
                system.due = self._due[row, index]

    def shared(self) -> tuple[int, int, int, int, int]:
        """Return the number of systems and four addresses, for an engine's native step loop.

        They are those of the table, of the rates [Hz], of when systems are due [ns], and of the time at
        which the steps end that are made at once [ns].
        """
        if not cython.compiled:
            KNOWN.update((id(each), each) for each in self.systems)
        return (
            len(self.systems),
            np.asarray(self._table).ctypes.data,
            np.asarray(self._rates).ctypes.data,
            np.asarray(self._due)[-1].ctypes.data,
            np.asarray(self._end).ctypes.data,
        )

    @cython.cfunc
    def _update_due(self, row: cython.Py_ssize_t, late: cython.longlong) -> Any:
        """Update the systems that are due at this time, those that are late or the others.

        Those that are late measure, and threads share them if there is enough for each.
        """
        index: cython.Py_ssize_t
        for index in range(self._table.shape[0]):
            acts: cython.longlong = self._table[index, ACTS]
            between: cython.bint = acts == BETWEEN or acts == AHEAD  # noqa: PLR1714  of C
            if not between or self._table[index, LATE] != late:
                continue
            if not self._is_due(row, index, self.time):
                pass
            elif late and self._pool is not None and self._table[index, DIVISIBLE]:
                self._pool.update(self.systems[index], self.nworld, self.time)
            else:
                with cython.nogil:
                    self._update(index, 0, self.nworld * self._table[index, ROWS], self.time, 1)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _steps_to_due(self, row: cython.Py_ssize_t, until: cython.longlong) -> cython.longlong:
        """Return the steps until a system is due or a time has come, one at least."""
        soonest: cython.longlong = until
        index: cython.Py_ssize_t
        for index in range(self._table.shape[0]):
            if self._table[index, ACTS] != BETWEEN:
                continue
            if self._rates[index] > 0.0 or not self._table[index, STEADY]:
                soonest = min(soonest, self._due[row, index])
        return max(1, (soonest - self.time + self.step - 1) // self.step)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _pass_within(self, row: cython.Py_ssize_t) -> cython.void:
        """Advance the due times of systems past the steps in which they were updated."""
        index: cython.Py_ssize_t
        last: cython.longlong = self._end[0] - self.step
        for index in range(self._table.shape[0]):
            if self._table[index, ACTS] == BETWEEN or self._rates[index] <= 0.0:
                continue
            if self._due[row, index] <= last:
                self._due[row, index] = next_due(last, self._rates[index])

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _pass(self, row: cython.Py_ssize_t, until: cython.longlong) -> cython.void:
        """Advance the time and the due times of systems."""
        if self.time >= until:
            return
        self.time += (until - self.time + self.step - 1) // self.step * self.step
        index: cython.Py_ssize_t
        for index in range(self._table.shape[0]):
            self._is_due(row, index, self._moment_of(index, self.time - self.step))

    def play_worlds(
        self, part: cython.Py_ssize_t, blocks: cython.Py_ssize_t, until: cython.longlong
    ) -> None:
        """Run a thread's part where worlds are divided; ``run`` calls it."""
        with cython.nogil:
            self._play_worlds(part, blocks, until)

    def play_together(
        self, part: cython.Py_ssize_t, threads: cython.Py_ssize_t, until: cython.longlong
    ) -> None:
        """Run a thread's part where systems are divided; ``run`` calls it."""
        with cython.nogil:
            self._play_together(part, threads, until)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _play_worlds(
        self, part: cython.Py_ssize_t, blocks: cython.Py_ssize_t, until: cython.longlong
    ) -> cython.void:
        """Run blocks of worlds through all steps, as long as there are any left."""
        time: cython.longlong
        block: cython.longlong
        self._begin(part)
        while True:
            block = next_block(self._shared)
            if block >= blocks:
                return
            first: cython.Py_ssize_t = self.nworld * block // blocks
            last: cython.Py_ssize_t = self.nworld * (block + 1) // blocks
            self._begin(part)
            time = self.time
            while time < until:
                time += self.step * self._make_steps(part, first, last, time, until)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _make_steps(
        self, part: cython.Py_ssize_t, first: cython.Py_ssize_t, last: cython.Py_ssize_t,
        time: cython.longlong, until: cython.longlong,
    ) -> cython.longlong:  # fmt: skip
        """Update worlds for a step, or for as many as are merged; returns their number."""
        count: cython.longlong = 0  # not known before the first system that merges steps
        index: cython.Py_ssize_t
        for index in range(self._table.shape[0]):
            rows: cython.longlong = self._table[index, ROWS]
            if self._table[index, MERGEABLE]:
                if count == 0:
                    count = self._steps_alike(part, index, time, until)
                self._update(index, first * rows, last * rows, time, count)
                continue
            when: cython.longlong = self._moment_of(index, time + max(count - 1, 0) * self.step)
            if self._is_due(part, index, when):
                self._update(index, first * rows, last * rows, when, 1)
        return max(count, 1)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _steps_alike(
        self, part: cython.Py_ssize_t, index: cython.Py_ssize_t, time: cython.longlong,
        until: cython.longlong,
    ) -> cython.longlong:  # fmt: skip
        """Return the steps that systems can merge from a time on, the first of them being ``index``.

        Others before them are due again only after these steps, and others after them only in the last.
        """
        count: cython.longlong = (until - time + self.step - 1) // self.step
        each: cython.Py_ssize_t
        for each in range(self._table.shape[0]):
            if self._rates[each] > 0.0 or not (
                self._table[each, MERGEABLE] or self._table[each, STEADY]
            ):
                ahead: cython.longlong = self._due[part, each] - time + self.step - 1
                steps: cython.longlong = max(ahead, 0) // self.step - self._table[each, LATE]
                count = min(count, max(steps + (each > index), 1))
        return count

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _play_together(
        self, part: cython.Py_ssize_t, threads: cython.Py_ssize_t, until: cython.longlong
    ) -> cython.void:
        """Run a share of every system, with a barrier before and after each.

        What cannot be shared out, or is not worth it, is done by the last thread, which waits for
        no other between two of them.
        """
        index: cython.Py_ssize_t
        self._begin(part)
        time: cython.longlong = self.time
        alone: cython.bint = True  # whether what was done since all waited was not shared out
        while time < until:
            for index in range(self._table.shape[0]):
                when: cython.longlong = self._moment_of(index, time)
                if self._is_due(part, index, when):
                    rows: cython.longlong = self._table[index, ROWS]
                    unit: cython.longlong = 1 if self._table[index, DIVISIBLE] else rows
                    count: cython.longlong = self.nworld * rows // unit
                    worth: cython.longlong = count * unit // self._table[index, LEAST]
                    parts: cython.longlong = max(1, min(threads, worth, count))
                    if not (alone and parts == 1):
                        self._wait_for_all(threads)
                    alone = parts == 1
                    mine: cython.longlong = part - (threads - parts)
                    first: cython.longlong = count * mine // parts
                    last: cython.longlong = count * (mine + 1) // parts
                    if mine >= 0:
                        self._update(index, first * unit, last * unit, when, 1)
            time += self.step

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _moment_of(self, index: cython.Py_ssize_t, time: cython.longlong) -> cython.longlong:
        """Return the time of an update in the step that begins at a time [ns]."""
        return time + self._table[index, LATE] * self.step

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _wait_for_all(self, threads: cython.Py_ssize_t) -> cython.void:
        """Return when all threads have called it."""
        if cython.compiled:
            gazelle_wait_for_all(cython.address(self._shared[APART]), threads)  # type: ignore[name-defined]  # noqa: F821

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _begin(self, part: cython.Py_ssize_t) -> cython.void:
        """Reset the due times of systems for a thread to those at the start of the run."""
        index: cython.Py_ssize_t
        for index in range(self._due.shape[1]):
            self._due[part, index] = self._due[self._due.shape[0] - 1, index]

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _is_due(
        self, part: cython.Py_ssize_t, index: cython.Py_ssize_t, time: cython.longlong
    ) -> cython.bint:
        """Return whether a system is due in a step, and advance it to the next multiple of its period."""
        if self._due[part, index] > time:
            return False
        rate: cython.double = self._rates[index]
        if rate > 0.0:
            self._due[part, index] = next_due(time, rate)
        return True

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _update(
        self, index: cython.Py_ssize_t, first: cython.Py_ssize_t, last: cython.Py_ssize_t,
        time: cython.longlong, count: cython.longlong,
    ) -> cython.void:  # fmt: skip
        if cython.compiled:
            place: cython.p_void = cython.cast(cython.p_void, self._table[index, ADDRESS])
            cython.cast(System, place).update_steps(first, last, time, count)
        else:
            self.systems[index].update_steps(first, last, time, count)
