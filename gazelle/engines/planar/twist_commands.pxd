cimport cython

from gazelle.engines.planar.bodies cimport Bodies
from gazelle.native.system cimport System

cdef class TwistCommands(System):
    cdef public Bodies bodies
    cdef double[:, :, :] linear, angular
    cdef double[:, ::1] rates
    cdef Py_ssize_t[::1] body, first_joint, width
    @cython.locals(row=Py_ssize_t, w=Py_ssize_t, i=Py_ssize_t, b=Py_ssize_t, axis=Py_ssize_t, joint=Py_ssize_t, wanted=double)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
