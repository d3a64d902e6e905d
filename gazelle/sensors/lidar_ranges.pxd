cimport cython
from gazelle.native.white_noise cimport fill_normal


@cython.final
cdef class RangeLaw:
    cdef readonly double low, high, quantum, mean, precision
    cdef double[::1] row, room

    @cython.locals(noisy=cython.bint, v=double, true=double, far=double)
    cdef void measure_one(
        self, Py_ssize_t w, double[:, ::1] ranges, double offset, double[:, ::1] deviation,
        double[:, ::1] bias, unsigned long long[::1] keys, unsigned long long[::1] counters,
        double[:, ::1] measured) noexcept nogil
    cpdef void measure(
        self, double[:, ::1] ranges, double offset, double[:, ::1] deviation,
        double[:, ::1] bias, unsigned long long[::1] keys, unsigned long long[::1] counters,
        double[:, ::1] measured) noexcept
