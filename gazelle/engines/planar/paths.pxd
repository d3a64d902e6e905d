cimport cython

from gazelle.engines.planar.bodies cimport Bodies
from gazelle.native.paths cimport PathSystem

cdef double PI

cdef class PathFollower(PathSystem):
    cdef Bodies bodies
    cdef Py_ssize_t body
    cdef double heading
    @cython.locals(w=Py_ssize_t, b=Py_ssize_t, leg=Py_ssize_t, moment=double)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil

cdef void put(Bodies w, Py_ssize_t b, double x, double y, double z, double yaw) noexcept nogil
