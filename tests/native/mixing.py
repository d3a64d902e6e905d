"""Systems that remember what was updated when, as another package would write them."""

import cython
from cython.cimports.gazelle.native.system import System


@cython.cclass
class Mix(System):
    """Each row mixes the time into its number, and what another row of its world has."""

    numbers: cython.ulonglong[::1]
    others: cython.ulonglong[::1]
    beside: cython.Py_ssize_t

    def __init__(self, numbers, others, beside, rows, rate, divisible):
        System.__init__(self, rows, rate, divisible)
        self.numbers, self.others, self.beside = numbers, others, beside

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def update(
        self, first: cython.Py_ssize_t, last: cython.Py_ssize_t, time: cython.longlong
    ) -> cython.void:
        row: cython.Py_ssize_t
        for row in range(first, last):
            world: cython.Py_ssize_t = row // self.rows
            other: cython.Py_ssize_t = world * self.rows + (row + self.beside) % self.rows
            mixed: cython.ulonglong = self.numbers[row] ^ self.others[other] ^ time
            self.numbers[row] = (mixed * 1103515245 + 12345) & 0x7FFFFFFF
