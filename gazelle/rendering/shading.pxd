cimport cython

from gazelle.rendering.lighting cimport Lighting
from gazelle.rendering.rasterizer cimport Rasterizer
from gazelle.rendering.sunlight cimport Sunlight


@cython.final
cdef class Shader:
    cdef readonly Rasterizer seen
    cdef readonly Lighting lighting
    cdef unsigned char[:, :, :, ::1] color
    cdef float[:, :, ::1] depth
    cdef int[:, :, ::1] labels
    cdef bint colored, measured, labelled
    cdef float[:, ::1] planes
    cdef unsigned char[:, ::1] flat
    cdef double[:, ::1] corners, bends, shares
    cdef double[::1] light, normal, base, behind
    cdef Sunlight sun
    cdef double[:, ::1] even
    cdef bint shadowed, distant
    cdef Py_ssize_t slots

    cdef void draw_one(self, Py_ssize_t n) noexcept nogil
    @cython.locals(
        color=cython.uchar[:, :, :, ::1], owner=int[:, ::1], last=int, t=int, s=Py_ssize_t,
        red=cython.uchar, green=cython.uchar, blue=cython.uchar, constant=cython.bint, fourth=cython.bint,
        r=int, c=int)
    cdef void put_color(self, Py_ssize_t n) noexcept nogil
    @cython.locals(r=int, c=int, t=int, k=int, s=Py_ssize_t, p=Py_ssize_t, alpha=double,
                   mixed=double)
    cdef void put_clear(self, Py_ssize_t n) noexcept nogil
    cdef void shade(
        self, Py_ssize_t n, Py_ssize_t r, Py_ssize_t c, Py_ssize_t s, Py_ssize_t t) noexcept nogil
    @cython.locals(x=double, y=double, z=double, share=double, k=int)
    cdef void shade_evenly(
        self, Py_ssize_t n, Py_ssize_t r, Py_ssize_t c, Py_ssize_t s) noexcept nogil
    @cython.locals(z=cython.float, value=cython.float, x=int)
    cdef void shade_smoothly(
        self, Py_ssize_t n, Py_ssize_t r, Py_ssize_t c, Py_ssize_t s) noexcept nogil
    @cython.locals(z=double, value=double)
    cdef void shade_picture(
        self, Py_ssize_t n, Py_ssize_t r, Py_ssize_t c, Py_ssize_t s, Py_ssize_t p) noexcept nogil
    @cython.locals(k=int, j=int, x=double, y=double, u=double, v=double, wide=Py_ssize_t,
                   high=Py_ssize_t, first=Py_ssize_t, a=Py_ssize_t, b=Py_ssize_t, at=Py_ssize_t,
                   d=Py_ssize_t, e=Py_ssize_t)
    cdef void find_base(
        self, Py_ssize_t s, Py_ssize_t p, Py_ssize_t r, Py_ssize_t c, double z) noexcept nogil
    @cython.locals(x=double, y=double, z=double, size=double, p=Py_ssize_t, b=double)
    cdef void shade_exactly(
        self, Py_ssize_t n, Py_ssize_t r, Py_ssize_t c, Py_ssize_t s, Py_ssize_t t) noexcept nogil
    @cython.locals(x=double, y=double, up=double)
    cdef void put_backdrop(self, Py_ssize_t n, Py_ssize_t r, Py_ssize_t c) noexcept nogil
    @cython.locals(s=Py_ssize_t, k=int, j=int)
    cdef Py_ssize_t prepare(self, Py_ssize_t t) noexcept nogil
    @cython.locals(flat=cython.bint, worn=cython.bint, i=int, k=int)
    cdef bint light_corners(self, Py_ssize_t p) noexcept nogil
    @cython.locals(i=int, j=int, k=int, value=double)
    cdef void light_evenly(self, Py_ssize_t s, Py_ssize_t p) noexcept nogil
    @cython.locals(v=Py_ssize_t, first=Py_ssize_t, x=double, y=double, z=double, i=int, k=int,
                   facing=double)
    cdef void find_corners(self, Py_ssize_t t) noexcept nogil
    @cython.locals(i=int, j=int, k=int, off=double, x=double, y=double, z=double)
    cdef void find_shares(self) noexcept nogil
    @cython.locals(depth=cython.float[:, :, ::1], inverse=cython.float[:, ::1], owner=int[:, ::1],
                   r=int, c=int)
    cdef void put_depth(self, Py_ssize_t n, bint over) noexcept nogil
    @cython.locals(t=int, r=int, c=int)
    cdef void put_labels(self, Py_ssize_t n, bint over) noexcept nogil
