"""Times at which something with a rate is due."""

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.libc.math import floor, rint


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def moment(count: cython.longlong, rate: cython.double) -> cython.longlong:
    """Return the count-th due time of something with a rate [Hz], in ns."""
    return cython.cast(cython.longlong, rint(cython.cast(cython.double, count * 1000000000) / rate))


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def next_due(time: cython.longlong, rate: cython.double) -> cython.longlong:
    """Return the first due time of something with a rate [Hz] after a time [ns]."""
    count: cython.longlong = cython.cast(cython.longlong, floor(time * rate / 1e9))
    due: cython.longlong = moment(count, rate)
    while due <= time:
        count += 1
        due = moment(count, rate)
    return due
