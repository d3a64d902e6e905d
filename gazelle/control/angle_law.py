"""Distances between two angles, as ``angles`` has them of arrays."""

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.libc.math import fmod

_HALF = cython.declare(cython.double, 3.141592653589793)
_TURN = cython.declare(cython.double, 6.283185307179586)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def shortest(start: cython.double, end: cython.double) -> cython.double:
    """By how much to turn from one angle to another, the shorter way round [rad]; pi stays pi."""
    turn: cython.double = end - start
    if not -_TURN < turn < _TURN:
        turn = fmod(turn, _TURN)
    if turn < 0.0:
        turn += _TURN
    return turn - _TURN if turn > _HALF else turn


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def distance(
    start: cython.double,
    end: cython.double,
    continuous: cython.bint,
    lower: cython.double,
    upper: cython.double,
) -> cython.double:
    """By how much to turn: the shorter way round if that stays within limits, or if neither does."""
    short: cython.double = shortest(start, end)
    if continuous or lower <= start + short <= upper:
        return short
    other: cython.double = short - _TURN if short > 0.0 else short + _TURN
    return other if lower <= start + other <= upper else short
