cimport cython
from gazelle.native.system cimport System


@cython.final
cdef class RangeLaw:
    cdef readonly double low, high, quantum, mean, precision


@cython.final
cdef class LidarNoise:
    cdef double[:] deviation
    cdef unsigned long long[:] keys, counters
    cdef double[:, :] bias


@cython.locals(v=double)
cdef void add_noise(
    LidarNoise noise, Py_ssize_t m, double[::1] ranges, Py_ssize_t count, double offset,
    double mean, double[::1] measured) noexcept nogil
@cython.locals(v=double, true=double, far=double)
cdef void measure_row(
    RangeLaw law, LidarNoise noise, Py_ssize_t m, double[::1] ranges, Py_ssize_t count,
    double offset, double[::1] measured) noexcept nogil
cpdef void measure(
    RangeLaw law, LidarNoise noise, double[:, ::1] ranges, double offset,
    double[:, ::1] measured) noexcept

@cython.locals(k=Py_ssize_t, near="double[::1]", each="double[::1]")
cpdef infinite_from(double reach, ranges)


cdef class LidarSystem(System):
    cdef System cast
    cdef double[:, ::1] ranges, measured
    cdef double offset
    cdef RangeLaw law
    cdef LidarNoise noise
    cdef object values, stamps
    cdef long long[::1] stamp
    cpdef renew(self)
    cpdef latest(self)
    @cython.locals(m=Py_ssize_t, begin=Py_ssize_t, end=Py_ssize_t, some=Py_ssize_t)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
