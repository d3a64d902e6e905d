cimport cython


@cython.final
cdef class ClearSpace:
    cdef readonly double[::1] fine
    cdef readonly int[::1] start, items
    cdef readonly signed char[::1] clear

    @cython.locals(inside=cython.bint)
    cdef bint is_clear(self, double height) noexcept nogil


@cython.locals(quadrant=Py_ssize_t, least=Py_ssize_t, inside=cython.bint, step=Py_ssize_t, line=Py_ssize_t)
cpdef void measure_clear(
    signed char[::1] solid, int[::1] start, Py_ssize_t columns, signed char[::1] clear) noexcept
