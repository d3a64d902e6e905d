cimport cython

from gazelle.engines.planar.bodies cimport Bodies
from gazelle.native.system cimport System

cdef class RoamingLaw(System):
    cdef Bodies bodies
    cdef double[:, ::1] ranges
    cdef long long[::1] sensor
    cdef public long long[:, ::1] turn_state
    cdef double cruise, turning, avoid_distance
    cdef long long keep, back, seed
    cpdef void choose(self, long long time)
    @cython.locals(b=Py_ssize_t)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
    cdef void back_off(self, Py_ssize_t b, long long time) noexcept nogil
    cdef bint turns_away(self, Py_ssize_t b) noexcept nogil

@cython.locals(k=Py_ssize_t, count=Py_ssize_t)
cdef (double, double) sides(double[:, ::1] ranges, Py_ssize_t m) noexcept nogil
