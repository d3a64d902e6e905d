cimport cython

from gazelle.rendering.rasterizer cimport Rasterizer


@cython.final
cdef class Sunlight:
    cdef Rasterizer shadow
    cdef double[:, ::1] turns
    cdef double pixel
    cdef readonly bint there

    cdef void draw(self, Py_ssize_t n) noexcept nogil
    @cython.locals(u=double, v=double, w=double, lit=double, lift=double, i=Py_ssize_t,
                   j=Py_ssize_t)
    cdef double share(
        self, Py_ssize_t n, double x, double y, double z, double a, double b,
        double c) noexcept nogil
