cimport cython

from gazelle.native.system cimport System

cdef class Wandering(System):
    cdef double[:, ::1] commands, ranges
    cdef long long[::1] sensors, owners
    cdef public long long[:, ::1] turn_state
    cdef double cruise, creep, turn, front, stop
    cdef long long patience, seed
    cpdef void choose(self, Py_ssize_t first, Py_ssize_t last, long long time)
    @cython.locals(i=Py_ssize_t, near=bint, halt=bint)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil

cdef Py_ssize_t FEW

@cython.locals(k=Py_ssize_t, count=Py_ssize_t, third=Py_ssize_t, half=Py_ssize_t, begin=Py_ssize_t,
               end=Py_ssize_t, ahead=double, right=double, left=double, found=double)
cdef (double, double, double) room(double[:, ::1] ranges, Py_ssize_t m) noexcept nogil
