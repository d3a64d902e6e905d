cimport cython
from gazelle.formats.integer_hull cimport HullBuilder

cdef enum:
    LANES = 16


cdef class BlockCutter:
    cdef Py_ssize_t count
    cdef float[:, ::1] around, some, of_points, of_air
    cdef float[::1] below, above
    cdef HullBuilder builder

    @cython.locals(i=int, k=Py_ssize_t, width=Py_ssize_t, x=float, y=float, z=float, along=float)
    cdef void reach(self, float[:, ::1] points, float[::1] top, int[::1] first) noexcept nogil
    @cython.locals(i=Py_ssize_t, begin=Py_ssize_t, width=Py_ssize_t, last=Py_ssize_t,
                   x=float, y=float, z=float)
    cdef void keep(
        self, float[:, ::1] air, float[::1] top, unsigned char[::1] kept) noexcept nogil
    @cython.locals(k=Py_ssize_t, count=int, along=float)
    cdef int beyond(
        self, float x, float y, float z, Py_ssize_t begin, float[::1] top) noexcept nogil
    @cython.locals(i=Py_ssize_t, last=int)
    cdef void hold(
        self, double[:, ::1] hull, float[:, ::1] air, unsigned char[::1] kept) noexcept nogil
    @cython.locals(i=Py_ssize_t, k=Py_ssize_t, count=Py_ssize_t, width=Py_ssize_t, cut=int,
                   best=int, axis=int, under=Py_ssize_t, level=double, least=double, cost=double,
                   share=double, along=float)
    cdef int choose(
        self, float[:, ::1] points, float[:, ::1] air, int[::1] axes, double[::1] levels,
        double uneven) noexcept nogil
    @cython.locals(i=Py_ssize_t, k=Py_ssize_t, x=float, y=float, z=float)
    cdef void measure(self, float[:, ::1] places, float[:, ::1] found) noexcept nogil
    @cython.locals(i=Py_ssize_t, k=Py_ssize_t, held=int, over=int, under=int)
    cdef int left(self, Py_ssize_t count) noexcept nogil
