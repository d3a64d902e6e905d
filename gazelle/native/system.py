"""All parts of one kind in all worlds: arrays, and one update without Python."""

# mypy: disallow-untyped-decorators=False

from typing import Any

import cython
from cython.cimports.gazelle.native.blocks import next_block

HEAP_TYPE = 1 << 9
"""Py_TPFLAGS_HEAPTYPE: a class that is made at run time, as the stable ABI makes all."""


@cython.cclass
class System:
    """Base of systems, which update all their rows together; kernels override ``update``.

    Its arrays have the worlds along their first axis and ``rows`` rows for each, so row
    ``world * rows + part`` belongs to a part. Subclasses keep them as attributes, typed memory
    views, which Python made and may look at between two runs.

    Args:
        rows: In each world.
        rate: Updates in a simulated second [Hz], at multiples of its period counted from time zero,
            on the first step not before; 0: at every step.
        divisible: Whether rows of one world may be updated by different threads, as they need
            nothing of each other that this update changes.

    Attributes:
        due: Time of the next update [ns]; 0 for at once.
        late: Whether it is updated after all that moves, for the end of the step.
        steady: Whether it does nothing new in a step until a system with a rate, or Python, changes its inputs.
        mergeable: Whether ``update_steps`` makes many steps at once where no system with a rate is due between.
        least: Fewer rows are not worth a thread.
        uses: Arrays of an engine that it reads or writes, such as ``motor_targets``. An engine that can
            show them in the middle of its steps updates it there; None: others may be needed, and it
            acts between two steps.

    Raises:
        TypeError: A subclass is compiled without Python's stable ABI.
        ValueError: ``rows`` is less than 1, or ``rate`` than 0.
    """

    def __init__(
        self,
        rows: cython.Py_ssize_t = 1,
        rate: cython.double = 0.0,
        divisible: cython.bint = True,  # noqa: FBT002  # subclasses pass all three in order
        due: cython.longlong = 0,
    ) -> None:
        if rows < 1 or not rate >= 0.0:
            raise ValueError(f"a system has {rows} rows, and is updated {rate} times a second")
        if not type(self).__flags__ & HEAP_TYPE:  # the end of such an object would free its class
            raise TypeError(
                f"{type(self).__name__} is compiled without Py_LIMITED_API=0x030B0000, which "
                "Gazelle's own modules use"
            )
        self.rows, self.rate, self.divisible, self.due = rows, rate, divisible, due
        self.late, self.least = False, 1
        self.steady = self.mergeable = False
        self.uses: Any = None

    def update_from_python(self, first: int, last: int, time: int) -> None:
        """Call ``update`` from Python; other threads run meanwhile."""
        begin: cython.Py_ssize_t = first
        end: cython.Py_ssize_t = last
        when: cython.longlong = time
        with cython.nogil:
            self.update(begin, end, when)

    def update_blocks(self, taken: Any, blocks: int, rows: int, time: int) -> None:
        """Update blocks of rows that no thread has taken, as long as there are any left.

        Args:
            taken: Number of blocks that threads have taken, shape (1,).
            blocks: Number of blocks.
            rows: Number of rows.
            time: Simulated time [ns].
        """
        counter: cython.longlong[::1] = taken
        count: cython.longlong = blocks
        end: cython.longlong = rows
        when: cython.longlong = time
        block: cython.longlong
        with cython.nogil:
            while True:
                block = next_block(counter)
                if block >= count:
                    break
                self.update(end * block // count, end * (block + 1) // count, when)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def update(
        self, first: cython.Py_ssize_t, last: cython.Py_ssize_t, time: cython.longlong
    ) -> cython.void:
        """Update the rows from ``first`` to before ``last`` to a time.

        Called without the interpreter's lock, by several threads for different rows. What comes
        out may not depend on how rows are shared out.

        Args:
            first: Row, counted through all worlds.
            last: The one after the last.
            time: At the beginning of the step, or at its end for those that are late [ns].
        """

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def update_steps(
        self,
        first: cython.Py_ssize_t,
        last: cython.Py_ssize_t,
        time: cython.longlong,
        count: cython.Py_ssize_t,
    ) -> cython.void:
        """Update rows for many steps, with the same bits as ``update`` for one after another.

        Args:
            first: As for ``update``.
            last: Likewise.
            time: At the beginning of the first step [ns].
            count: Number of steps.
        """
        for _ in range(count):
            self.update(first, last, time)
