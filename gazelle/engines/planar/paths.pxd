cimport cython

from gazelle.engines.planar.bodies cimport Bodies
from gazelle.native.system cimport System

cdef double PI

cdef class PathFollower(System):
    cdef public Bodies bodies
    cdef public Py_ssize_t body
    cdef public bint loop
    cdef public double spin, yaw
    cdef public double[:, ::1] points
    cdef public double[::1] start, epoch
    @cython.locals(w=Py_ssize_t, b=Py_ssize_t, leg=Py_ssize_t)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
    @cython.locals(leg=Py_ssize_t)
    cdef (double, double, double) place(self, double elapsed) noexcept nogil

cdef void put(Bodies w, Py_ssize_t b, double x, double y, double z, double yaw) noexcept nogil
