# What angle_law.py says, for compiled modules.

from libc.math cimport fmod


cdef inline double shorter(double turn) noexcept nogil:
    turn = turn + 6.283185307179586 if turn < 0.0 else turn
    return turn - 6.283185307179586 if turn > 3.141592653589793 else turn


cdef inline double shortest(double start, double end) noexcept nogil:
    cdef double turn = end - start
    if not -6.283185307179586 < turn < 6.283185307179586:
        turn = fmod(turn, 6.283185307179586)
    return shorter(turn)


cdef inline double within(double start, double short, double lower, double upper) noexcept nogil:
    cdef double other = short - 6.283185307179586 if short > 0.0 else short + 6.283185307179586
    other = other if lower <= start + other and start + other <= upper else short
    return short if lower <= start + short and start + short <= upper else other


cdef inline double distance(double start, double end, bint continuous, double lower, double upper) noexcept nogil:
    cdef double short = shortest(start, end)
    return short if continuous else within(start, short, lower, upper)
