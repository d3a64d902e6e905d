cimport cython

from gazelle.engines.planar.bodies cimport Bodies
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
    cdef Bodies bodies
    cdef public double[:, ::1] poses
    @cython.locals(b=Py_ssize_t)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil

cdef class StallMemory(System):
    cdef Bodies bodies
    cdef public unsigned char[::1] stalled
    @cython.locals(b=Py_ssize_t)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil

cdef class DriveVelocities(System):
    cdef Bodies bodies
    cdef public double[:, ::1] velocities
    @cython.locals(b=Py_ssize_t)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil

@cython.locals(k=Py_ssize_t, vx=double, turn=double)
cdef void note_velocity(Bodies w, Py_ssize_t b, double[:, ::1] velocities) noexcept nogil
