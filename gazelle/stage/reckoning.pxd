cimport cython

from gazelle.native.system cimport System

cdef class Reckoning(System):
    cdef double[:, ::1] velocity
    cdef public double[:, ::1] share, pose
    cdef Py_ssize_t count, stride
    cdef double dt
    cdef bint euler
    cpdef void reckon(self)
    @cython.locals(i=Py_ssize_t, b=Py_ssize_t, heading=double, chord=double, half=double,
                   yaw=double)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil

cdef class PoseMemory(System):
    cdef const double[:, :] now
    cdef public double[:, ::1] poses
    @cython.locals(b=Py_ssize_t)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil

cdef class StallMemory(System):
    cdef const unsigned char[::1] now
    cdef public unsigned char[::1] stalled
    @cython.locals(b=Py_ssize_t)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
