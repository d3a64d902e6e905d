cimport cython
from gazelle.geometry.integer_hull cimport HullBuilder


cdef class AirProbes:
    cdef HullBuilder builder
    cdef double[:, ::1] places
    cdef int[::1] starts
    cdef double[::1] low
    cdef double side
    cdef Py_ssize_t[::1] cells
    cdef Py_ssize_t[:, ::1] box
    cdef int[::1] rows

    @cython.locals(n=int)
    cdef int keep(self, double[:, ::1] points) noexcept nogil
    @cython.locals(axis=Py_ssize_t, n=Py_ssize_t, i=Py_ssize_t, j=Py_ssize_t, row=Py_ssize_t,
                   last=int, least=double, most=double, box=Py_ssize_t[:, ::1])
    cdef bint search(self, double[:, ::1] points) noexcept nogil
    @cython.locals(cell=double)
    cdef Py_ssize_t cell_of(self, double place, Py_ssize_t axis) noexcept nogil
