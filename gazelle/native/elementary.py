"""Sine, cosine, arc tangent and logarithm to the same bits on every processor.

C libraries have several versions of these, of which they take one that suits the processor, or
round as the release of the system does. Here are sums and products only, of which IEEE 754 says
every bit. Results are within 1 unit in the last place of the exact ones, arc tangents within 2.

Angles are reduced by a half turn in three parts (Cody and Waite, "Software Manual for the
Elementary Functions", 1980); beyond ``_FAR`` they are first made small with less care, as what is
turned so often has no direction any more. The rest are Taylor series, on intervals so
short that what is cut off is below rounding.
"""

# mypy: disallow-untyped-decorators=False

import math

import cython
import numpy as np
from cython.cimports.libc.math import copysign, fabs, floor, frexp, isnan

_PI = cython.declare(cython.double, math.pi)
_PI_LOW = cython.declare(cython.double, 1.2246467991473532e-16)
_TWO_PI = cython.declare(cython.double, 2.0 * math.pi)
_OVER_HALF_PI = cython.declare(cython.double, 0.6366197723675814)
_HALF_PI_1 = cython.declare(cython.double, 1.570796325802803)  # 30 bits, so that 23 are left
_HALF_PI_2 = cython.declare(cython.double, 9.920935791635221e-10)  # 30 bits
_HALF_PI_3 = cython.declare(cython.double, 5.170182981794105e-19)
_FAR = cython.declare(cython.double, 1e6)
_LOG_2_1 = cython.declare(cython.double, 0.6931471803691238)  # 32 bits
_LOG_2_2 = cython.declare(cython.double, 1.9082149292705877e-10)
_HALF_ROOT = cython.declare(cython.double, 0.7071067811865476)
_NONE = cython.declare(cython.double, math.nan)
_LIMITLESS = cython.declare(cython.double, math.inf)

# atan(k / 16), and what is left of it.
_ANGLES = cython.declare(cython.double[17])
_RESTS = cython.declare(cython.double[17])
for _k, (_angle, _rest) in enumerate(
    (
        (0.0, 0.0),
        (0.06241880999595735, -1.5490756308295046e-18),
        (0.12435499454676144, -3.1253241424539383e-18),
        (0.18534794999569476, 4.180692268843079e-18),
        (0.24497866312686414, 1.0698755618734451e-17),
        (0.3028848683749714, -1.1010827903001369e-17),
        (0.35877067027057225, -2.4623815582638635e-17),
        (0.4124104415973873, -1.587652227770689e-17),
        (0.4636476090008061, 2.2698777452961687e-17),
        (0.5123894603107377, -2.5462781472855804e-17),
        (0.5585993153435624, -5.4556305485916264e-18),
        (0.6022873461349642, 2.950430737228402e-17),
        (0.6435011087932844, 1.5834785051444286e-17),
        (0.6823165548747481, 6.943223671560008e-18),
        (0.7188299996216245, -2.1478388444456983e-17),
        (0.7531512809621944, -2.4256934659182068e-17),
        (0.7853981633974483, 3.061616997868383e-17),
    )
):
    _ANGLES[_k] = _angle
    _RESTS[_k] = _rest


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _sine(x: cython.double, low: cython.double) -> cython.double:
    """Return sin(x + low) within an eighth of a turn.

    Two sums at a time take half as long as one.
    """
    z = x * x
    q = z * z
    plus = 1.0 / 6.0 + q * (1.0 / 5040.0 + q * (1.0 / 39916800.0 + q * (1.0 / 1307674368000.0)))
    minus = 1.0 / 120.0 + q * (
        1.0 / 362880.0 + q * (1.0 / 6227020800.0 + q * (1.0 / 355687428096000.0))
    )
    r = z * (plus - z * minus)
    return x - (x * r - low * (1.0 - 0.5 * z))


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _cosine(x: cython.double, low: cython.double) -> cython.double:
    """Return cos(x + low) within an eighth of a turn."""
    z = x * x
    q = z * z
    plus = 1.0 / 24.0 + q * (1.0 / 40320.0 + q * (1.0 / 479001600.0 + q * (1.0 / 20922789888000.0)))
    minus = 1.0 / 720.0 + q * (1.0 / 3628800.0 + q * (1.0 / 87178291200.0))
    r = q * (plus - z * minus)
    half = 0.5 * z
    one = 1.0 - half
    return one + (((1.0 - one) - half) + (r - x * low))


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _turned(x: cython.double, quarters: cython.double) -> cython.double:
    """Return sin(x + quarters of a turn)."""
    if fabs(x) > _FAR:
        x = x - floor(x / _TWO_PI + 0.5) * _TWO_PI
        if not fabs(x) <= _FAR:
            return _NONE
    n = floor(x * _OVER_HALF_PI + 0.5)
    # The first product is exact, and so is the difference.
    first = x - n * _HALF_PI_1
    second = n * _HALF_PI_2
    high = first - second
    less = ((first - high) - second) - n * _HALF_PI_3
    near = high + less
    low = (high - near) + less
    quadrant: cython.double = n + quarters
    which: cython.int = cython.cast(cython.int, quadrant - 4.0 * floor(0.25 * quadrant))
    found = _sine(near, low) if which % 2 == 0 else _cosine(near, low)
    return found if which < 2 else -found


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def sin(x: cython.double) -> cython.double:
    """Return sine of an angle [rad]; NaN of what is not finite."""
    if fabs(x) < 1e-8:
        return x
    return _turned(x, 0.0)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def cos(x: cython.double) -> cython.double:
    """Return cosine of an angle [rad]; NaN of what is not finite."""
    return _turned(x, 1.0)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def atan2(y: cython.double, x: cython.double) -> cython.double:
    """Return the angle of (x, y) from the x axis [rad], in [-pi, pi], also of (0, 0)."""
    if isnan(y) or isnan(x):
        return _NONE
    wide, high = fabs(x), fabs(y)
    steep: cython.bint = high > wide
    less: cython.double = wide if steep else high
    more: cython.double = high if steep else wide
    if more == 0.0:
        angle: cython.double = 0.0
        rest: cython.double = 0.0
    elif more == _LIMITLESS:
        angle = _ANGLES[16] if less == more else 0.0
        rest = 0.0
    else:
        if more > 1e300 or more < 1e-290:  # products below would have no room
            less, more = less / more, 1.0
        k: cython.int = cython.cast(cython.int, 16.0 * (less / more) + 0.5)
        part = 0.0625 * k
        t = (less - part * more) / (more + part * less)
        z = t * t
        tail = z * (
            1.0 / 3.0 - z * (1.0 / 5.0 - z * (1.0 / 7.0 - z * (1.0 / 9.0 - z * (1.0 / 11.0))))
        )
        rest = _RESTS[k] - t * tail
        angle = _ANGLES[k]
        total = angle + t
        rest += (angle - total) + t if fabs(angle) > fabs(t) else (t - total) + angle
        angle = total
    if steep:
        angle, rest = 0.5 * _PI - angle, 0.5 * _PI_LOW - rest
    if x < 0.0:
        angle, rest = _PI - angle, _PI_LOW - rest
    return copysign(angle + rest, y)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def log(x: cython.double) -> cython.double:
    """Return the natural logarithm; -inf of 0, NaN of what is below."""
    if not x > 0.0:
        return -_LIMITLESS if x == 0.0 else _NONE
    if x == _LIMITLESS:
        return x
    power: cython.int = 0
    if cython.compiled:
        m = frexp(x, cython.address(power))
    else:
        m, power = math.frexp(x)
    if m < _HALF_ROOT:
        m, power = 2.0 * m, power - 1
    f = m - 1.0
    s = f / (2.0 + f)
    z = s * s
    q = z * z
    even = 1.0 / 3.0 + q * (1.0 / 7.0 + q * (1.0 / 11.0 + q * (1.0 / 15.0 + q * (1.0 / 19.0))))
    odd = 1.0 / 5.0 + q * (1.0 / 9.0 + q * (1.0 / 13.0 + q * (1.0 / 17.0 + q * (1.0 / 21.0))))
    r = z * (even + z * odd)
    # 2 s is f - s f.
    return power * _LOG_2_1 + (f - (s * f - (2.0 * s * r + power * _LOG_2_2)))


def on_arrays(name: str, first: cython.double[::1], second: cython.double[::1]) -> object:
    """Return a function of numbers, or of pairs, by its name; for tests and for NumPy's side.

    Returns:
        As many numbers.
    """
    found = np.empty(first.shape[0])
    out: cython.double[::1] = found
    i: cython.Py_ssize_t
    which: cython.int = ("sin", "cos", "log", "atan2").index(name)
    for i in range(first.shape[0]):
        if which == 0:
            out[i] = sin(first[i])
        elif which == 1:
            out[i] = cos(first[i])
        elif which == 2:
            out[i] = log(first[i])
        else:
            out[i] = atan2(first[i], second[i])
    return found
