# What angle_law.py says, for compiled modules.

from libc.math cimport fmod


cdef inline double shortest(double start, double end) noexcept nogil:
    cdef double turn = end - start
    if not -6.283185307179586 < turn < 6.283185307179586:
        turn = fmod(turn, 6.283185307179586)
    if turn < 0.0:
        turn += 6.283185307179586
    return turn - 6.283185307179586 if turn > 3.141592653589793 else turn


cdef inline double distance(double start, double end, bint continuous, double lower, double upper) noexcept nogil:
    cdef double short = shortest(start, end)
    if continuous or (lower <= start + short and start + short <= upper):
        return short
    cdef double other = short - 6.283185307179586 if short > 0.0 else short + 6.283185307179586
    return other if lower <= start + other and start + other <= upper else short
