cimport cython

from gazelle.engines.planar.bodies cimport Bodies
from gazelle.native.system cimport System

cdef class DriveVelocities(System):
    cdef Bodies bodies
    cdef public double[:, ::1] velocities
    @cython.locals(b=Py_ssize_t)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil

cdef void note_velocity(Bodies w, Py_ssize_t b, double[:, ::1] velocities) noexcept nogil
